// One Sinumerik 840D sl block: reference-language 1.4 (frame), 1.8 (dispatch), 4.1 (operators), 6-8 and 12 (statements).
parser grammar SinumerikParser;
options { tokenVocab = SinumerikLexer; }

block: (skip? blockNumber? label* content? | header) COMMENT? EOF;

header: HEADER;
skip: SLASH INTEGER?;
blockNumber: (LETTER_N | COLON) INTEGER;
label: (name | letter INTEGER?) COLON;

content
  : ifPart+                                                        # ifBlock
  | keyword = (ELSE | ENDIF | LOOP | ENDLOOP | ENDFOR | ENDWHILE)  # structureWord
  | FOR lvalue ASSIGN expr TO expr                                 # forOpen
  | WHILE condition                                                # whileOpen
  | UNTIL condition                                                # untilClose
  | REPEAT (target target?)? repeatCount?                          # repeatRange
  | REPEATB target repeatCount?                                    # repeatBlock
  | jump                                                           # jumpOnly
  | CASE expr OF caseArm* (DEFAULT jump)?                          # caseJump
  | DEF defPart* TYPE stringLength? defPart* defVariable (COMMA? defVariable)* COMMA?  # definition
  | REDEF anyToken+                                                # redefinition
  | (DEF_LIMIT number)+                                            # accessRights    // APR 7 APW 11, for the definitions that follow
  | DEFINE anyName AS anyToken*                                    # macroDefinition
  | EXTERN anyName (LPAREN (parameterType (COMMA parameterType)*)? RPAREN)?   # externDeclaration
  | PROC procName (LPAREN (parameter (COMMA parameter)*)? RPAREN)? name*      # procHead
  | CALL expr? (BLOCK expr TO expr)? repeatCount?                  # callText
  | TEXTCALL expr                                                  # callExternal
  | PCALL (SLASH? pathPart (SLASH pathPart)*) arguments?           # callPath
  | MCALL (name arguments? | letter INTEGER arguments?)?           # modalCall
  | (SYNC_ID ASSIGN expr)? (SYNC syncUnit? condition)? DO syncUnit? item*  # syncAction
  | item+                                                          # items
  ;

ifPart: IF condition jump?;  // with a jump: a conditional jump; without: opens IF ... ENDIF
jump: GOTO gotoTarget;
gotoTarget: COLON INTEGER | expr;
caseArm: expr jump;
repeatCount: letter ASSIGN? expr;
target: name | (LETTER_N | COLON) INTEGER;
syncUnit: letter INTEGER;
condition: expr (ASSIGN mirrored = (LT | GT)? expr)?;  // `=`, `=<`, `=>`: spelled the other way round

// ---- items: words, assignments, names, calls ----
item
  : letter sign = (PLUS | MINUS)? number           # wordNumber    // X-10.5  G1  L0123
  | letter INTEGER? ASSIGN expr                   # wordValue     // X=R1*2  M2=3  R1=5
  | letter INTEGER arguments                       # numberedCall  // L140(2)
  | name ASSIGN expr                              # nameValue     // CR=5  RND=2  COUNT=COUNT+1
  | indexed ASSIGN expr                           # indexedValue  // POS[X]=5  R[3]=1  $P_UIFR[1,X,TR]=0
  | SYSVAR ASSIGN expr                            # systemValue
  | name LBRACK argumentList RBRACK                # indexedItem   // DIAMONA[X]  FINEA[X]
  | name arguments                                 # callItem      // CYCLE81(50,0,2,-10)
  | name                                           # nameItem      // TRANS  DIAMON  TOOL_CHANGE
  | letter                                         # letterItem    // an address without its value: reported later
  ;

lvalue: indexed | name | SYSVAR | letter INTEGER?;
indexed: (name | SYSVAR | letter INTEGER?) LBRACK argumentList RBRACK;
arguments: LPAREN argumentList RPAREN;
argumentList: argument (COMMA argument)*;
argument: expr?;

// ---- expressions; the order of the alternatives is the priority, comparisons bind weakest ----
expr
  : primary                                                        # operand
  | op = (NOT | B_NOT | PLUS | MINUS) expr                         # prefixOperation
  | expr op = COLON expr                                           # infixOperation
  | expr op = (STAR | SLASH | DIV | MOD) expr                      # infixOperation
  | expr op = (PLUS | MINUS) expr                                  # infixOperation
  | expr op = B_AND expr                                           # infixOperation
  | expr op = B_XOR expr                                           # infixOperation
  | expr op = B_OR expr                                            # infixOperation
  | expr op = AND expr                                             # infixOperation
  | expr op = XOR expr                                             # infixOperation
  | expr op = OR expr                                              # infixOperation
  | op = CONCAT expr                                               # prefixOperation
  | expr op = CONCAT expr                                          # infixOperation
  | expr op = (EQ | NE | GE | LE | GT | LT) expr                   # infixOperation
  ;

primary
  : number                         # numberOperand
  | BASED                          # basedOperand
  | CHARACTER                      # characterOperand
  | STRING                         # stringOperand
  | LPAREN condition (COMMA argument)* RPAREN  # parenthesised   // with commas: a list of values, only right of `=`
  | indexed                        # indexedOperand
  | name arguments                 # functionOperand
  | SYSVAR                         # systemOperand
  | name                           # nameOperand
  | letter INTEGER?                # letterOperand
  ;

number: INTEGER | REAL;
letter: LETTER | LETTER_N | LETTER_R;
name: IDENT | SYNC_ID | TYPE | DEF_FLAG | DEF_LIMIT | VAR | BLOCK;
anyName: name | letter INTEGER?;

// ---- definitions ----
defPart: DEF_FLAG | DEF_LIMIT (PLUS | MINUS)? number;
stringLength: LBRACK expr RBRACK;
defVariable: anyName dimensions? (ASSIGN expr)?;
dimensions: LBRACK argumentList RBRACK;
procName: name | letter INTEGER | INTEGER;
parameter: VAR? TYPE stringLength? anyName dimensions? (ASSIGN expr)?;
parameterType: VAR? TYPE stringLength? anyName? dimensions?;
pathPart: name | letter INTEGER | DOT DOT?;

anyToken
  : IF | ELSE | FOR | TO | WHILE | GOTO | CALL | PCALL | MCALL | TEXTCALL | SYNC | SYNC_ID | DO | DIV | MOD | NOT | AND | OR | XOR | B_NOT | B_AND
  | B_OR | B_XOR | TYPE | DEF_FLAG | DEF_LIMIT | VAR | BLOCK | LETTER_N | LETTER_R | LETTER | IDENT | SYSVAR | INTEGER | REAL
  | BASED | CHARACTER | STRING | LPAREN | RPAREN | LBRACK | RBRACK | COMMA | COLON | CONCAT | EQ | NE | GE | LE | GT | LT
  | ASSIGN | PLUS | MINUS | STAR | SLASH | DOT
  ;

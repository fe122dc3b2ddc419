// Fagor 8055 (T and M models): one block, that is one line without its line end. The `%` lines (file header, start mark of
// the main part) are not blocks. What a word or a statement means is not decided here: any letter, any list is accepted.
parser grammar FagorParser;

options { tokenVocab = FagorLexer; }

// §2.1: skip marks, label, then either ISO words or one high-level statement, then the repeat count, then the comment.
// Among the words the repeat count is the word N.
block : skipMark* label? (statementBlock | word*) COMMENT? EOF ;

skipMark : SLASH NUMBER? ;
label : N NUMBER ;

// --- ISO ------------------------------------------------------------------------------------------------------------
word
  : address value?                               # plainWord
  | address ext = NUMBER? EQUALS value         # assignedWord     // G180 P1=5 A=3 (§12.5)
  ;
address : LETTER | N | P ;
value : sign = (PLUS | MINUS)? (P? NUMBER) ;     // P100: the value of a parameter (§11.2.1)

// --- high-level language --------------------------------------------------------------------------------------------
statementBlock : LPAREN statement RPAREN repeat? ;
repeat : N value? ;

statement
  : IF expr action (ELSE action)?                # ifStatement
  | SUB expr                                     # subStatement
  | action                                       # actionStatement
  ;

action
  : GOTO N expr                                                               # gotoAction
  | RPT N expr COMMA N expr (COMMA program)?                                  # rptAction
  | CALL expr                                                                 # callAction
  | PCALL expr (COMMA argument?)*                                             # pcallAction
  | WRITE WRITTEN_TEXT?                                                       # writeAction
  | PROGRAM program (COMMA (DEVICE | letter | STRING))*                       # programAction
  | KEYWORD (item (COMMA item)*)?                                             # keywordAction
  | assignment (COMMA assignment)*                                            # assignAction
  | letter letter+ item (COMMA item)*                                         # unknownAction
  ;

// A program's number: digits after P are the number itself, not a parameter (§12.5, §12.8)
program : PARAM | P PARAM | P LPAREN expr RPAREN ;

item : STRING | expr ;

argument
  : assignment
  | letter sign = (PLUS | MINUS)? PARAM          // SP100 for S=P100
  | letter                                       // the axis list of TRACE, and letters without a value
  ;

assignment
  : target EQUALS (STRING | inputForm | expr)    # fullAssignment
  | letter sign = (PLUS | MINUS)? NUMBER         # shortAssignment  // A13.7 for A=13.7
  ;
inputForm : INPUT STRING (COMMA sign = (PLUS | MINUS)? NUMBER)? ;

target : letter | PARAM | P LPAREN expr RPAREN | variable | unknown ;

// Priority and grouping of §11.5.1; every binary operator groups from the left
expr
  : op = (MINUS | PLUS | NOT | FUNCTION) expr            # prefixExpr
  | expr op = POWER expr                                 # binaryExpr
  | expr op = (STAR | SLASH) expr                        # binaryExpr
  | expr op = (PLUS | MINUS) expr                        # binaryExpr
  | expr op = RELATION expr                              # binaryExpr
  | expr op = AND expr                                   # binaryExpr
  | expr op = OR expr                                    # binaryExpr
  | ARG LPAREN expr COMMA expr RPAREN                    # argExpr
  | LPAREN expr RPAREN                                   # groupExpr
  | (NUMBER | HEX | PI)                                  # constantExpr
  | PARAM                                                # paramExpr
  | P LPAREN expr RPAREN                                 # indirectExpr
  | variable                                             # variableExpr
  | unknown                                              # unknownExpr
  | letter                                               # letterExpr
  ;

variable
  : VAR_INDEXED indexValue
  | VAR_MAYBE_INDEXED indexValue?
  | GPOS N? indexValue PARAM                                  // GPOSX N99 P100: axis X in block 99 of program 100
  | VAR_PLAIN (LPAREN expr (COMMA expr)+ RPAREN)?        // LUP(a,b)
  ;
indexValue : NUMBER | PARAM | letter | LPAREN expr RPAREN ;
unknown : letter letter+ indexValue? ;                        // a name this control family may have and the manual does not
letter : LETTER | N | P ;

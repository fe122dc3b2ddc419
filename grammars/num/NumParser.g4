// NUM 750/760/1020/1040/1050/1060: one block. Comments are on the hidden channel. Round brackets never group
// arithmetic: an expression is read strictly left to right, and a function binds the next primary only.
parser grammar NumParser;
options { tokenVocab = NumLexer; }

block : SLASH? number? content EOF;

number : N NUMBER;

content
  : header
  | statement
  | item* message?
  ;

// %12, %12.2 (axis group 2); % alone is a tape mark.
header : PERCENT NUMBER?;

message : MESSAGE;

item
  : G_TEST test?           # testItem
  | G_TEST_NUMBER testRest? # testNumberItem
  | G_CODE sign?           # codeItem
  | G_LETTER_O             # letterOItem
  | G sign NUMBER          # signedCodeItem
  | G                      # bareCodeItem
  | address value?         # wordItem
  | E sign                 # discriminantItem
  | variable EQ expression # assignItem
  | variable EQ MESSAGE    # inputItem
  | symbol                 # declareItem
  | AT equalAddress EQ equalAddress # equivalenceItem
  ;

equalAddress : address | L;

address : ADDRESS | FUNCTION | E_LETTER | NU | N;

// A word's value starts with a number or a variable, never with a function: `X S500` is two words.
value
  : sign? operand (operation primary)*
  | sign
  ;

// After G79 (G10): `L1 < 5`, or `L4 = L3*2 > 8`, which assigns first.
test : (variable EQ)? expression relation expression;

// ... after its first number.
testRest : (operation primary)* relation expression;

relation : LE | GE | NE | LT | GT | EQ;
sign : PLUS | MINUS;
operation : PLUS | MINUS | TIMES | SLASH | AMPERSAND | BANG;

expression : sign? primary (operation primary)*;
primary : operand | FUNCTION primary;
operand : NUMBER | variable;

variable
  : L NUMBER
  | E NUMBER
  | symbol
  | QUOTE aliasAddress
  ;
aliasAddress : ADDRESS | FUNCTION | E_LETTER | L | N;

symbol : SYM_OPEN SYM_NAME (SYM_LPAREN index (SYM_COMMA index)* SYM_RPAREN)? SYM_END;
index : SYM_OP? indexOperand (SYM_OP indexOperand)*;
indexOperand : SYM_NUMBER | SYM_NAME | symbol;

statement
  : KW_IF condition KW_THEN?                                                        # ifStatement
  | KW_THEN                                                                         # thenStatement
  | KW_ELSE                                                                         # elseStatement
  | KW_ENDI                                                                         # endIfStatement
  | KW_WHILE condition KW_DO?                                                       # whileStatement
  | KW_DO                                                                           # doStatement
  | KW_ENDW                                                                         # endWhileStatement
  | KW_REPEAT                                                                       # repeatStatement
  | KW_UNTIL condition                                                              # untilStatement
  | KW_FOR variable EQ expression (KW_TO | KW_DOWNTO) expression (KW_BY expression)? KW_DO? # forStatement
  | KW_ENDF                                                                         # endForStatement
  | KW_EXIT                                                                         # exitStatement
  | KW_VAR                                                                          # varStatement
  | KW_ENDV                                                                         # endVarStatement
  | KW_CARRIED                                                                      # carriedStatement
  ;

condition : comparison ((KW_AND | KW_OR) comparison)*;
comparison : expression relation expression;

// One line of an iTNC 530 program (reference 1.11, 12, 13).
parser grammar HeidenhainParser;
options { tokenVocab = HeidenhainLexer; }

block : SLASH? (blockNumber SLASH?)? content? TILDE? COMMENT? EOF;
blockNumber : NUMBER;

content
  : VARIABLE EQUALS expression   # assignment   // Q5 = Q1 * (SIN Q2 + 4); also a parameter of a cycle: Q201=-15
  | WORD WORD VARIABLE EQUALS expression   # declaration   // DECLARE STRING QS10 = "text"
  | VARIABLE EQUALS WORD sign* (NUMBER | VARIABLE)?   # named   // a parameter of a cycle: Q206=FAUTO, Q207=FZ0.1
  | FN NUMBER COLON function     # fn
  | STAR ~(COMMENT)*             # outline      // * - text: a heading
  | item+                        # sentence
  ;

function
  : VARIABLE EQUALS operand                                             # fnAssign
  | VARIABLE EQUALS operand op = (PLUS | MINUS | STAR | WORD) operand   # fnBinary
  | VARIABLE EQUALS WORD operand                                        # fnPrefix
  | IF operand WORD operand GOTO item+                                  # fnJump
  | ~(COMMENT | IF)+                                                    # fnOther
  ;
operand : sign? (NUMBER | VARIABLE);
sign : PLUS | MINUS;

// The order of the alternatives is the priority; all group from the left.
expression
  : primary                                            # operandOnly
  | sign expression                                    # signed
  | expression op = POWER expression                   # infix
  | expression op = (STAR | SLASH | PERCENT) expression  # infix
  | expression op = (PLUS | MINUS) expression          # infix
  | expression op = CONCAT expression                  # infix
  ;
primary
  : NUMBER                        # number
  | VARIABLE                      # variable
  | STRING                        # text
  | PI                            # pi
  | WORD sign? primary            # prefixed       // SIN Q1, SRC_QS10, STRLEN ( SRC_QS15 )
  | LPAREN expression+ RPAREN     # parenthesised  // several: what a function of texts is given
  ;

item
  : WORD sign* (NUMBER | VARIABLE)   # valueWord   // X+10, F500, IPA-45, XQ5
  | WORD sign                        # signWord    // DR+
  | (WORD | FN | IF | GOTO | PI)     # bareWord    // FMAX, RL, TOOL
  | sign* (NUMBER | VARIABLE)        # bareValue
  | STRING                           # quoted
  | (PLUS | MINUS | STAR | SLASH | PERCENT | POWER | CONCAT | LPAREN | RPAREN | EQUALS | COLON | OTHER)   # mark
  ;

// Heidenhain iTNC 530, conversational: tokens of one line. Blanks separate nothing. A comma is a decimal point.
lexer grammar HeidenhainLexer;

COMMENT : ';' ~[\r\n]*;
WS : [ \t]+ -> skip;

// Typographic quotes too, in UTF-8 and in the code page of the control.
STRING : QUOTE ~["\r\n]*? QUOTE;
fragment QUOTE : '"' | '\u00E2' '\u0080' [\u009C-\u009F] | [\u0093\u0094\u0084];

FN : [Ff] [Nn];
IF : [Ii] [Ff];
GOTO : [Gg] [Oo] [Tt] [Oo];
PI : [Pp] [Ii];
VARIABLE : [Qq] [LlRrSs]? D+;
NUMBER : D+ ([.,] D*)? | [.,] D+;
// Words that hold a Q.
WORD_Q : ([Ss] [Qq] ([Rr] [Tt])? | [Ss] [Ee] [Qq] | [Ee] [Qq] [Uu] | [Qq] [LlRrSsCc]?) -> type(WORD);
WORD : L+;

PLUS : '+';
MINUS : '-';
STAR : '*';
SLASH : '/';
PERCENT : '%';
POWER : '^';
CONCAT : '||';
LPAREN : '(';
RPAREN : ')';
EQUALS : '=';
COLON : ':';
TILDE : '~';
OTHER : .;

fragment D : [0-9];
fragment L : [A-PR-Za-pr-z_] | [\u0080-\u00FF];

// NUM 750/760/1020/1040/1050/1060: tokens of one block. Blanks separate nothing, so they may stand inside words and
// between the digits of a number; letters are single tokens, because a longer identifier rule would swallow `X100`.
// The word mode (default) knows no keyword. The statement mode adds the keywords of the structured statements; the
// reader selects it when a block begins with one of them (on a 7xx control it never does: there `IF` is I0 F0).
lexer grammar NumLexer;

tokens { SYM_END }

COMMENT : '(' ~[)\r\n]* ')' -> channel(HIDDEN);
MESSAGE : '$' ~[\r\n]*;
WS : [ \t]+ -> skip;

// The G codes that own a test, and the others. `G` alone is G0; `GO` is a misprint for G0 that programs do contain.
G_TEST : [Gg] B* ('0' B*)* ('7' B* '9' | '1' B* '0');
// `G79 5<L1`: a test that begins with a number; without a relation the digits belong to the code.
G_TEST_NUMBER
  : [Gg] B* ('0' B*)* ('7' B* '9' | '1' B* '0') B+ (D (B* D)* (B* '.' (B* D)*)? | '.' B* D (B* D)*)
  ;
G_CODE : [Gg] B* (D (B* D)* (B* '.' (B* D)*)? | '.' B* D (B* D)*);
G_LETTER_O : [Gg] B* [Oo];
G : [Gg];
NU : [Nn] B* [Uu];
N : [Nn];
L : [Ll];
E_LETTER : [Ee] B* [A-Za-z];
E : [Ee];
FUNCTION : [SCARTscart];
ADDRESS : [BDFHIJKMPQUVWXYZbdfhijkmpquvwxyz];
NUMBER : D (B* D)* (B* '.' (B* D)*)? | '.' B* D (B* D)*;

LE : '<' B* '=';
GE : '>' B* '=';
NE : '<' B* '>';
LT : '<';
GT : '>';
EQ : '=';
PLUS : '+';
MINUS : '-';
TIMES : '*';
SLASH : '/';
AMPERSAND : '&';
BANG : '!';
PERCENT : '%';
QUOTE : '\'';
AT : '@';
SYM_OPEN : '[' -> pushMode(SYMBOL);

fragment B : [ \t];
fragment D : [0-9];

// Inside [ ]: a name, with an index in round brackets.
mode SYMBOL;
SYM_WS : [ \t]+ -> skip;
SYM_NAME : [A-Za-z_.] [A-Za-z0-9_.]*;
SYM_NUMBER : [0-9]+;
SYM_LPAREN : '(';
SYM_RPAREN : ')';
SYM_COMMA : ',';
SYM_OP : [+*/-];
SYM_NESTED : '[' -> type(SYM_OPEN), pushMode(SYMBOL);
SYM_CLOSE : ']' -> type(SYM_END), popMode;

mode STATEMENT;
ST_COMMENT : '(' ~[)\r\n]* ')' -> type(COMMENT), channel(HIDDEN);
ST_MESSAGE : '$' ~[\r\n]* -> type(MESSAGE);
ST_WS : [ \t]+ -> skip;

KW_IF : [Ii] [Ff];
KW_THEN : [Tt] [Hh] [Ee] [Nn];
KW_ELSE : [Ee] [Ll] [Ss] [Ee];
KW_ENDI : [Ee] [Nn] [Dd] [Ii];
KW_WHILE : [Ww] [Hh] [Ii] [Ll] [Ee];
KW_DO : [Dd] [Oo];
KW_ENDW : [Ee] [Nn] [Dd] [Ww];
KW_REPEAT : [Rr] [Ee] [Pp] [Ee] [Aa] [Tt];
KW_UNTIL : [Uu] [Nn] [Tt] [Ii] [Ll];
KW_FOR : [Ff] [Oo] [Rr];
KW_TO : [Tt] [Oo];
KW_DOWNTO : [Dd] [Oo] [Ww] [Nn] [Tt] [Oo];
KW_BY : [Bb] [Yy];
KW_ENDF : [Ee] [Nn] [Dd] [Ff];
KW_EXIT : [Ee] [Xx] [Ii] [Tt];
KW_AND : [Aa] [Nn] [Dd];
KW_OR : [Oo] [Rr];
KW_VAR : [Vv] [Aa] [Rr];
KW_ENDV : [Ee] [Nn] [Dd] [Vv];
// Statements that are carried as text: table and stack functions.
KW_CARRIED
  : ( [Pp] [Uu] [Ss] [Hh] | [Pp] [Uu] [Ll] [Ll] | [Bb] [Uu] [Ii] [Ll] [Dd] | [Ss] [Ee] [Aa] [Rr] [Cc] [Hh] | [Cc] [Uu] [Tt]
    | [Rr] '.' [Oo] [Ff] [Ff] | [Bb] [Ss] [Ee] [Tt] | [Bb] [Cc] [Ll] [Rr] | [Mm] [Oo] [Vv] [Ee] | [Ss] [Oo] [Rr] [Tt]
    | [Ss] [Aa] [Vv] [Ee] | [Dd] [Ee] [Ll] [Ee] [Tt] [Ee] ) ~[\r\n]*
  ;

ST_N : [Nn] -> type(N);
ST_L : [Ll] -> type(L);
ST_E : [Ee] -> type(E);
ST_FUNCTION : [SCARTscart] -> type(FUNCTION);
ST_ADDRESS : [BDFHIJKMPQUVWXYZbdfhijkmpquvwxyz] -> type(ADDRESS);
ST_NUMBER : (SD (SB* SD)* (SB* '.' (SB* SD)*)? | '.' SB* SD (SB* SD)*) -> type(NUMBER);
ST_LE : '<' SB* '=' -> type(LE);
ST_GE : '>' SB* '=' -> type(GE);
ST_NE : '<' SB* '>' -> type(NE);
ST_LT : '<' -> type(LT);
ST_GT : '>' -> type(GT);
ST_EQ : '=' -> type(EQ);
ST_PLUS : '+' -> type(PLUS);
ST_MINUS : '-' -> type(MINUS);
ST_TIMES : '*' -> type(TIMES);
ST_SLASH : '/' -> type(SLASH);
ST_AMPERSAND : '&' -> type(AMPERSAND);
ST_BANG : '!' -> type(BANG);
ST_SYM_OPEN : '[' -> type(SYM_OPEN), pushMode(SYMBOL);
fragment SB : [ \t];
fragment SD : [0-9];

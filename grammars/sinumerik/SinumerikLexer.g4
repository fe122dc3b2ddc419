// Tokens of one Sinumerik 840D sl block. Case does not count (reference 1.1), so keywords are spelled by letter fragments.
lexer grammar SinumerikLexer;

WS: [ \t\r\n\u000B\u000C\u001A\u0000\u00A0]+ -> skip;
COMMENT: ';' ~[\r\n]*;

// Structured statements, jumps, definitions, calls, synchronised actions: reserved.
IF: I F;
ELSE: E L S E;
ENDIF: E N D I F;
LOOP: L O O P;
ENDLOOP: E N D L O O P;
FOR: F O R;
TO: T O;
ENDFOR: E N D F O R;
WHILE: W H I L E;
ENDWHILE: E N D W H I L E;
REPEAT: R E P E A T;
REPEATB: R E P E A T B;
UNTIL: U N T I L;
CASE: C A S E;
OF: O F;
DEFAULT: D E F A U L T;
GOTO: G O T O [BbFfCc]?;
DEF: D E F;
REDEF: R E D E F;
DEFINE: D E F I N E;
AS: A S;
EXTERN: E X T E R N;
PROC: P R O C;
CALL: C A L L;
PCALL: P C A L L;
MCALL: M C A L L;
TEXTCALL: E X T C A L L | I S O C A L L;
SYNC: W H E N | W H E N E V E R | F R O M | E V E R Y;
DO: D O;

// Word operators.
DIV: D I V;
MOD: M O D;
NOT: N O T;
AND: A N D;
OR: O R;
XOR: X O R;
B_NOT: B '_' N O T;
B_AND: B '_' A N D;
B_OR: B '_' O R;
B_XOR: B '_' X O R;

// Words that are names everywhere but inside a definition or a call.
TYPE: I N T | R E A L | B O O L | C H A R | S T R I N G | A X I S | F R A M E;
DEF_FLAG: N C K | C H A N | S Y N R W? | S Y N W | I N I P O | I N I R E | I N I C F | P R L O C;
DEF_LIMIT: P H U | L L I | U L I | A P [RrWwXx] [PpBb]?;
VAR: V A R;
BLOCK: B L O C K;
SYNC_ID: I D S?;

// A line of the archive format, only as the first thing of a block.
HEADER: '%' ~[;\r\n]*;

// One letter: an address (X, G, R, N, L ...), an axis or a one-letter variable.
LETTER_N: N;
LETTER_R: R;
LETTER: [A-Za-z];
// Two leading letters or underscores: a name.
IDENT: [A-Za-z_] [A-Za-z_] [A-Za-z0-9_]*;
SYSVAR: '$' '$'? [A-Za-z_] [A-Za-z0-9_]*;

INTEGER: [0-9]+;
REAL: ([0-9]+ '.' [0-9]* | '.' [0-9]+) EXPONENT? | [0-9]+ EXPONENT;
BASED: '\'' ([Hh] [0-9A-Fa-f]+ | [Bb] [01]+) '\'';
CHARACTER: '\'' ~['\r\n] '\'' | '\'' [0-9] [0-9] [0-9]? '\'';
STRING: '"' ~["\r\n]* '"';

LPAREN: '(';
RPAREN: ')';
LBRACK: '[';
RBRACK: ']';
COMMA: ',';
COLON: ':';
CONCAT: '<<';
EQ: '==';
NE: '<>';
GE: '>=';
LE: '<=';
GT: '>';
LT: '<';
ASSIGN: '=';
PLUS: '+';
MINUS: '-';
STAR: '*';
SLASH: '/';
DOT: '.';

OPEN_STRING: '"' ~["\r\n]*;  // reported: the closing quotation mark is missing
OTHER: .;

fragment EXPONENT: [Ee] [Xx] [+-]? [0-9]+;
fragment A: [Aa];
fragment B: [Bb];
fragment C: [Cc];
fragment D: [Dd];
fragment E: [Ee];
fragment F: [Ff];
fragment G: [Gg];
fragment H: [Hh];
fragment I: [Ii];
fragment J: [Jj];
fragment K: [Kk];
fragment L: [Ll];
fragment M: [Mm];
fragment N: [Nn];
fragment O: [Oo];
fragment P: [Pp];
fragment R: [Rr];
fragment S: [Ss];
fragment T: [Tt];
fragment U: [Uu];
fragment V: [Vv];
fragment W: [Ww];
fragment X: [Xx];
fragment Y: [Yy];

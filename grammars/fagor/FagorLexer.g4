// Fagor 8055 (T and M models): tokens of one block.
//
// The reader hands over the line in capitals and with every byte above 127 replaced, one byte for one, so that a token's
// index is its byte offset in the line; texts are then taken from the line itself. Blanks have no meaning outside texts
// (manual ch. 2), so a mnemonic and its index may touch: `GOTONP100`, `ORGX54`. The longest mnemonic wins (§11.1).
//
// Default mode: ISO blocks. An opening bracket starts the high-level language, its closing bracket ends it.
lexer grammar FagorLexer;

LETTER : [A-MOQ-Z] ;
N : 'N' ;
P : 'P' ;
NUMBER : DIGIT+ ('.' DIGIT*)? | '.' DIGIT+ ;
PLUS : '+' ;
MINUS : '-' ;
SLASH : '/' ;
EQUALS : '=' ;
LPAREN : '(' -> pushMode(EXPRESSION) ;
COMMENT : ';' ~[\r\n]* ;
BLANK : [ \t]+ -> skip ;
BAD : . ;

fragment DIGIT : [0-9] ;
fragment AXIS : [A-CU-Z] ;

mode EXPRESSION;

E_LPAREN : '(' -> type(LPAREN), pushMode(EXPRESSION) ;
RPAREN : ')' -> popMode ;
STRING : '"' ~["\r\n]* '"' ;
HEX : '$' [0-9A-F]+ ;
E_NUMBER : (DIGIT+ ('.' DIGIT*)? | '.' DIGIT+) -> type(NUMBER) ;
PARAM : 'P' [ \t]* DIGIT+ ;
E_LETTER : [A-MOQ-Z] -> type(LETTER) ;
E_N : 'N' -> type(N) ;
E_P : 'P' -> type(P) ;
COMMA : ',' ;
E_EQUALS : '=' -> type(EQUALS) ;
E_PLUS : '+' -> type(PLUS) ;
E_MINUS : '-' -> type(MINUS) ;
STAR : '*' ;
E_SLASH : '/' -> type(SLASH) ;

// Statements with a shape of their own (ch. 12, §2.2)
IF : 'IF' ;
ELSE : 'ELSE' ;
GOTO : 'GOTO' ;
RPT : 'RPT' ;
SUB : 'SUB' | 'LSUB' ;
CALL : 'CALL' | 'LL' ;
PCALL : 'PCALL' | 'MCALL' | 'PROBE' | 'DIGIT' | 'TRACE' ;
WRITE : 'WRITE' -> pushMode(WRITTEN) ;
INPUT : 'INPUT' ;
PROGRAM : 'EXEC' | 'MEXEC' | 'OPEN' ;
DEVICE : 'HD' | 'DNC2' | 'DNCE' ;
// Statements that are a word and a list
KEYWORD
  : 'RET' | 'MDOFF' | 'MSG' | 'ERROR' | 'ERREUR' | 'DGWZ' | 'ESBLK' | 'DSBLK' | 'ESTOP' | 'DSTOP' | 'EFHOLD' | 'DFHOLD' | 'REPOS'
  | 'PAGE' | 'SYMBOL' | 'ODW' | 'WKEY' | 'WBUF' | 'SYSTEM'
  ;

// Operators and functions (§11.3, §11.4)
POWER : 'EXP' | 'MOD' ;
RELATION : 'EQ' | 'NE' | 'GT' | 'GE' | 'LT' | 'LE' ;
AND : 'AND' | 'XOR' ;
OR : 'OR' ;
NOT : 'NOT' ;
PI : 'PI' ;
FUNCTION
  : 'SIN' | 'COS' | 'TAN' | 'ASIN' | 'ACOS' | 'ATAN' | 'ABS' | 'LOG' | 'SQRT' | 'ROUND' | 'FIX' | 'FUP' | 'BCD' | 'BIN'
  ;
ARG : 'ARG' ;

// Variables that take an index (§11.2): digits, a parameter or an expression in brackets
VAR_INDEXED
  : 'TMZP' | 'TLFD' | 'TLFF' | 'TLFN' | 'TLFR' | 'TMZT' | 'TOX' | 'TOY' | 'TOZ' | 'TOF' | 'TOR' | 'TOI' | 'TOJ' | 'TOK' | 'TOL'
  | 'NOSEA' | 'NOSEW' | 'CUTA' | 'MPG' | 'MP' AXIS | 'MPS' | 'MPSS' | 'MPAS' | 'MPLC'
  | 'PLCI' | 'PLCO' | 'PLCM' | 'PLCR' | 'PLCT' | 'PLCC' | 'PLCMM' | 'GUP'
  | 'SVAR' AXIS | 'SVARS' | 'SSVARS' | 'TSVAR' AXIS | 'TSVARS' | 'TSSVAR'
  | 'GS' | 'MS' | 'ANAI' | 'ANAO' | 'TEMPI' | 'DW' | 'DWH' | 'DWB' | 'SK' | 'IB'
  ;
// With or without an index: ORGX is the active offset, ORGX54 the table's
VAR_MAYBE_INDEXED : 'ORG' AXIS ;
GPOS : 'GPOS' AXIS ;
VAR_PLAIN
  : 'TOOL' | 'TOD' | 'NXTOOL' | 'NXTOD' | 'PTOOL' | 'PNXTOOL' | 'HTOR'
  | 'PORGF' | 'PORGS' | 'PLCOF' AXIS | 'ADIOF' AXIS | 'ADDORG' AXIS | 'EXTORG'
  | ('F' | 'S' | 'T' | 'FO' | 'FI') 'ZONE' | ('F' | 'S' | 'T' | 'FO' | 'FI') 'Z' ('LO' | 'UP') AXIS
  | 'FREAL' AXIS? | 'FTEO' AXIS | 'FEED' | 'DNCF' | 'PLCF' | 'PRGF' | 'FPREV' | 'DNCFPR' | 'PLCFPR' | 'PRGFPR' | 'PRGFIN'
  | 'FRO' | 'PRGFRO' | 'DNCFRO' | 'PLCFRO' | 'CNCFRO' | 'PLCCFR'
  | ('PPOS' | 'POS' | 'TPOS' | 'APOS' | 'ATPOS' | 'FLWE' | 'DIST' | 'LIMPL' | 'LIMMI' | 'DPLY' | 'DRPO') AXIS
  | 'HANPF' | 'HANPS' | 'HANPT' | 'HANPFO' | 'HANDSE' | 'HANFCT' | 'HBEVAR' | 'MASLAN' | 'MASCFI' | 'MASCSE'
  | ('ASIN' | 'BSIN') (AXIS | 'S') | 'SASINS' | 'SBSINS'
  | 'SREAL' | 'FTEOS' | 'SPEED' | 'DNCS' | 'PLCS' | 'PRGS' | 'CSS' | 'DNCCSS' | 'PLCCSS' | 'PRGCSS'
  | 'SSO' | 'PRGSSO' | 'DNCSSO' | 'PLCSSO' | 'CNCSSO' | 'SLIMIT' | 'DNCSL' | 'PLCSL' | 'PRGSL' | 'MDISL'
  | 'POSS' | 'RPOSS' | 'TPOSS' | 'RTPOSS' | 'DRPOS' | 'PRGSP' | 'FLWES' | 'SYNCER'
  | 'SSREAL' | 'SFTEOS' | 'SSPEED' | 'SDNCS' | 'SPLCS' | 'SPRGS' | 'SCSS' | 'SDNCCS' | 'SPLCCS' | 'SPRGCS' | 'SSSO' | 'SPRGSO'
  | 'SDNCSO' | 'SPLCSO' | 'SCNCSO' | 'SSLIMI' | 'SDNCSL' | 'SPLCSL' | 'SPRGSL' | 'SPOSS' | 'SRPOSS' | 'STPOSS' | 'SRTPOS'
  | 'SDRPOS' | 'SPRGSP' | 'SFLWES' | 'ASPROG' | 'LIVRPM'
  | 'PLCMSG' | 'CALLP' | 'LUP' | 'SETGE' AXIS | 'SETGES' | 'SSETGS'
  | 'HARCON' | 'HARCOA' | 'IDHARH' | 'IDHARL' | 'SOFCON' | 'HDMEGA' | 'KEYIDE' | 'MODEL'
  | 'HARSWA' | 'HARSWB' | 'HARTST' | 'MEMTST' | 'NODE' | 'VCHECK' | 'IONODE' | 'IOSLOC' | 'IOSREM'
  | 'OPMODE' | 'OPMODA' | 'OPMODB' | 'OPMODC' | 'NBTOOL' | 'PRGN' | 'BLKN' | 'GGS' [A-Q] | 'GMS'
  | 'PLANE' | 'LONGAX' | 'MIRROR' | 'SCALE' AXIS? | 'ORGROT' | 'ORGRO' [XYZABCIJKQRS] | 'GTRATY'
  | 'PRBST' | 'CLOCK' | 'TIME' | 'DATE' | 'CYTIME' | 'TIMER' | 'PARTC' | 'FIRST' | 'KEY' | 'KEYSRC'
  | 'CNCERR' | 'PLCERR' | 'DNCERR' | 'DNCSTA' | 'AXICOM' | 'TANGAN' | 'TPIOUT' AXIS | 'TIMEG' | 'SELPRO' | 'DIAM' | 'PRBMOD'
  | 'RIP' | 'TIPPRB' | 'PANEDI' | 'DATEDI' | 'FBDIF' AXIS | 'CYCLEV' | 'CYCEDI' | 'DISBLO' | 'MIXPO' AXIS | 'FLWAC' AXIS
  | 'RADIOC' | 'DISABMOD' | 'CYCCHORDERR'
  ;

E_BLANK : [ \t]+ -> skip ;
E_BAD : . -> type(BAD) ;

// The text of WRITE: up to the bracket that closes the statement; inner brackets and texts in quotes stay whole (§12.8)
mode WRITTEN;

WRITTEN_TEXT : (~[()"\r\n] | QUOTED | NESTED)+ ;
W_RPAREN : ')' -> type(RPAREN), popMode, popMode ;
W_BAD : . -> type(BAD) ;
fragment QUOTED : '"' ~["\r\n]* '"' ;
fragment NESTED : '(' (~[()"\r\n] | QUOTED | NESTED)* ')' ;

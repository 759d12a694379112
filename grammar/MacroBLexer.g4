// Fanuc custom macro B: tokens. The input is bytes, one symbol a byte. Sources: R:n = section n of the reference
// on Macro B and its tags (T31, T6M: programs that ran; K: Fanuc's manuals as remembered); see docs/macrob.md.
// Blanks have no meaning (R:1.1), not inside words and numbers either.
lexer grammar MacroBLexer;

// A run of letters may hold several words, `THENGOTO`. Keywords are tried first, longest match, then single
// addresses (R:1.1). The token source (frontend/macrob/Tokens.cpp) does that, which keeps the automaton small.
tokens {
  // IF [..] GOTO n, IF [..] THEN statement, GOTO (R:1.7)
  KW_IF, KW_THEN, KW_GOTO,
  // WHILE [..] DO m ... END m (R:1.7)
  KW_WHILE, KW_DO, KW_END,
  // bitwise, or joining comparisons (R:1.4)
  KW_AND, KW_OR, KW_XOR,
  // remainder, 30i (R:1.5, K)
  KW_MOD,
  // EQ NE GT GE LT LE (R:1.4)
  RELATION,
  // SIN COS TAN ASIN ACOS ATAN SQRT ABS ROUND FIX FUP LN EXP BIN BCD POW ADP (R:1.5)
  FUNCTION,
  // POPEN, PCLOS open and close the port; DPRNT, BPRNT write to it (R:1.9)
  PORT, PRINT,
  // names common variables (R:1.9)
  KW_SETVN,
  // what DPRNT, BPRNT and SETVN have between brackets: text, blanks count (R:1.9)
  PRINT_TEXT,
  // letter of a word; N where it may number a block; O, which no block may hold
  ADDRESS, ADDRESS_N, ADDRESS_O
}

// ( text ), kept for the output; the front end says whether it may go over a line (R:1.1)
COMMENT : '(' ~[)]* ')' -> channel(HIDDEN) ;
BLANK : [ \t\u000B\u000C]+ -> skip ;
// end of block; `;` stands for it in print (R:1.1)
EOL : '\r'? '\n' | '\r' | ';' ;

WORD : [A-Za-z] ([ \t]* [A-Za-z])* ;
// digits with an optional point, no exponent (R:1.1)
NUMBER : DIGITS ([ \t]* '.' ([ \t]* DIGITS)?)? | '.' [ \t]* DIGITS ;

// variable #5, #[..] (R:1.1)
HASH : '#' ;
LBRACKET : '[' ;
RBRACKET : ']' ;
EQUALS : '=' ;
PLUS : '+' ;
MINUS : '-' ;
STAR : '*' ;
// block delete at the start of a block, division elsewhere (R:1.1)
SLASH : '/' ;
// ATAN[y,x] (R:1.5, K)
COMMA : ',' ;
// a point without digits: part of a misprint
POINT : '.' ;
// degree sign of printed text, UTF-8 and CP1250 (T6M)
DEGREE : '\u00C2'? '\u00B0' ;
// a character of several bytes
WIDE_CHARACTER : [\u00C2-\u00DF] [\u0080-\u00BF] | [\u00E0-\u00EF] [\u0080-\u00BF] [\u0080-\u00BF] | [\u00F0-\u00F4] [\u0080-\u00BF] [\u0080-\u00BF] [\u0080-\u00BF] ;
// anything else
ANY : . ;

fragment DIGITS : [0-9] ([ \t]* [0-9])* ;

// ComPost `Prog`: tokens. The input is bytes (UTF-8 or CP1250), one symbol a byte.
// Sources: T:n = line of the thesis text, W1 = vendor's page; see docs/compost.md.
lexer grammar ComPostLexer;

// Tokens that the token source tells apart (frontend/compost/Tokens.cpp), which keeps the automaton small.
tokens {
  // an opening bracket where no argument and no condition can begin
  STRAY_LPAREN,
  // The colon after a keyword is a slip that is reported; as a label, `ELSE:` would name a routine.
  // begins a conditional, begins its other branch, closes it (T:3487)
  KW_IF, KW_ELSE, KW_END,
  // ends a routine (T:3511)
  KW_RETURN,
  // both conditions hold (T:3890)
  KW_AND,
  // either condition holds, the condition does not hold: unverified
  KW_OR, KW_NOT,
  // ends the NC line (T:3523)
  KW_EOL,
  // ties a picture to a numeric keyword (T:3576)
  KW_FORMAT,
  // name: of a routine (T:3511); the colon directly follows the name
  LABEL,
  // numeric keyword (T:3531), boolean keyword (T:3497)
  NUMERIC, BOOLEAN,
  // command keyword or name of a routine (T:3513)
  NAME
}

// { text }, over several lines too; not compiled (W1, T:3711)
COMMENT : '{' ~[}]* '}' -> channel(HIDDEN) ;
// a comment that is never closed: to the end of the file, reported
UNTERMINATED_COMMENT : '{' ~[}]* -> channel(HIDDEN) ;
// blanks separate nothing but names (T:3633)
BLANK : [ \t\u000B\u000C]+ -> skip ;
// a line end ends no statement (T:3920)
NEWLINE : ('\r\n' | '\r' | '\n') -> skip ;

// a word with what marks its kind: `#`, `?` or `:` directly after it (T:3511, T:3497, T:3531). The token source
// makes one of the tokens above of it.
WORD : Letter (Letter | [0-9])* [#?:]? ;
// number of a picture that is being defined (T:3582)
PICTURE_NUMBER : '#' [ \t]* [0-9]+ ;
// number of a picture in FORMAT (T:3576)
INTEGER : [0-9]+ ;

// 'text', copied to the NC program (T:3541); ends on its line
LITERAL : '\'' ~['\r\n]* '\'' ;
// a text that its line does not close, reported
UNTERMINATED_LITERAL : '\'' ~['\r\n]* ;
// a text in quotes of a word processor, reported
TYPOGRAPHIC_TEXT : Quote ~[\r\n]*? (Quote | '\'') ;
// one such quote, reported
TYPOGRAPHIC_QUOTE : Quote ;

LPAREN : '(' ;
RPAREN : ')' ;
COMMA : ',' ;
EQUALS : '=' ;
COLON : ':' ;
// a character of several bytes
ODD_CHARACTER : [\u00C2-\u00DF] Tail | [\u00E0-\u00EF] Tail Tail | [\u00F0-\u00F4] Tail Tail Tail ;
// anything else
ANY : . ;

// Letters outside A to Z are unverified: several bytes of UTF-8, or one of CP1250.
fragment Letter
  : [A-Za-z_]
  | [\u00C3-\u00C5] Tail
  | [\u00E1\u00E3-\u00EF] Tail Tail
  | [\u00F0-\u00F4] Tail Tail Tail
  | [\u008A\u008C-\u008F\u009A\u009C-\u009F\u00A3\u00A5\u00AA\u00AF\u00B3\u00B9\u00BA\u00BC\u00BE-\u00C1\u00C3-\u00D6\u00D8-\u00E1\u00E3-\u00F6\u00F8-\u00FE]
  ;
fragment Tail : [\u0080-\u00BF] ;
// single and double quotes of word processors: UTF-8, then CP1250
fragment Quote : '\u00E2' '\u0080' [\u0098-\u009E] | [\u0082\u0084\u0091-\u0094] ;

// Tokens of the GibbsCAM macro language: .mac programs, .dlg dialogs, DefineData.txt. Works on bytes: a
// character above 127 is one or more tokens. Sources as in docs/gibbs.md: W-lang vendor wiki, C:n line n of
// the vendor's command list, T x.y thesis, M1 and M2 public macros, G editor grammar. "(U)": no source proves it.
lexer grammar GibbsMacroLexer;

tokens {
  // Words that a table tells apart (frontend/gibbs/Words.cpp), which keeps the automaton small.
  // Statement words (C:3-35). Only IF, THEN and NOT are no names elsewhere
  KW_IF, KW_THEN,
  // (U) neither in the vendor's list nor in the editor grammar
  KW_ELSE,
  KW_FOR, KW_TO, KW_STEP, KW_NEXT, KW_CONTINUE, KW_GOTO, KW_CALL, KW_ARGS, KW_GLOBAL, KW_LOCAL, KW_PERMANENT,
  // Error handler, followed by GOTO (C:2571)
  KW_ON_ERROR,
  // (U) no evidence of logical operators
  KW_AND, KW_OR, KW_NOT,
  // Ends in `_`: may be the first half of a word with a stray blank, `feed_ x` (T 6.2.4)
  OPEN_NAME,
  // Any other word, without and with `$`
  ID, TEXT_NAME,

  // What a word is at its place (frontend/gibbs/Roles.cpp). There are no reserved words, the place decides
  // (reference 2.2); with the place decided before, the parser needs no lookahead.
  // Variable, function, array, label that is jumped to
  NAME,
  // First word of a statement or of a control that is none of the statement words
  COMMAND,
  // A label where it is
  LABEL_NAME,
  // Piece of a file name without quotes
  FILE_PART,
  // Piece of a caption without quotes
  LOOSE_TEXT,
  // `(` around a comparison
  CONDITION_ROUND
}


// `!` to the end of the line (T 6.2); kept for the output
COMMENT : '!' ~[\r\n]* -> channel(HIDDEN) ;
// Blanks have no meaning (M1, M2)
BLANK : [ \t\f\u000B]+ -> skip ;
// One statement a line; LF, CR LF and CR (all listings)
EOL : '\r'? '\n' | '\r' ;

// The only word that begins with # (C:30)
HASH_INCLUDE : '#' [ \t]* [iI] [nN] [cC] [lL] [uU] [dD] [eE] ;

// Letter, then letters, digits, underscores (W-lang); case does not matter. A name of a text ends in `$`, which
// is part of it (W-lang). The token source says which of the words below it is.
WORD : [a-zA-Z] [a-zA-Z0-9_]* '$'? ;

// 54, 3.42 (W-lang, T); `.5`, `5.` and exponents (U)
NUMBER : DIGIT+ ('.' DIGIT*)? EXPONENT? | '.' DIGIT+ EXPONENT? ;

// Between double quotes, without escapes (W-lang, M1); a doubled quote inside (U)
TEXT : '"' (~["\r\n] | '""')* '"' ;
// A text that its line does not close
OPEN_TEXT : '"' (~["\r\n] | '""')* ;
// Between single quotes (U; G)
SINGLE_TEXT : '\'' ~['\r\n]* '\'' ;
// A text in single quotes that its line does not close
OPEN_SINGLE_TEXT : '\'' ~['\r\n]* ;
// What word processors make of quotes (T 6.2.2): UTF-8, and CP1250 as single bytes
TYPOGRAPHIC_QUOTE : '\u00E2' '\u0080' [\u0098-\u009F] | [\u0082\u0084\u0091-\u0094] ;

// Operators of expressions and conditions (W-lang, T, G)
PLUS : '+' ;
MINUS : '-' ;
STAR : '*' ;
SLASH : '/' ;
NOT_EQUAL : '<>' ;
LESS_EQUAL : '<=' ;
GREATER_EQUAL : '>=' ;
LESS : '<' ;
GREATER : '>' ;
EQUAL : '=' ;
LEFT_ROUND : '(' ;
RIGHT_ROUND : ')' ;
// Alone on a line they open and close a block (C:133); around an index (U)
LEFT_SQUARE : '[' ;
RIGHT_SQUARE : ']' ;
// Between arguments (M1, M2, T)
COMMA : ',' ;
// Before or after the name of a label (T 6.3, C:28)
COLON : ':' ;
// In bare file names only (U)
DOT : '.' ;
BACKSLASH : '\\' ;

// A character of several bytes (UTF-8) that no rule takes
WIDE_CHARACTER : [\u00C2-\u00F4] [\u0080-\u00BF]+ ;
// Anything else: reported by the front end
OTHER : . ;

fragment DIGIT : [0-9] ;
fragment EXPONENT : [eE] [+\-]? [0-9]+ ;

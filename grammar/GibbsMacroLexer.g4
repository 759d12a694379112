// Tokens of the GibbsCAM macro language: .mac programs, .dlg dialogs, DefineData.txt. Works on bytes: a
// character above 127 is one or more tokens. Sources as in docs/gibbs.md: W-lang vendor wiki, C:n line n of
// the vendor's command list, T x.y thesis, M1 and M2 public macros, G editor grammar. "(U)": no source proves it.
lexer grammar GibbsMacroLexer;

// `!` to the end of the line (T 6.2); kept for the output
COMMENT : '!' ~[\r\n]* -> channel(HIDDEN) ;
// Blanks have no meaning (M1, M2)
BLANK : [ \t\f\u000B]+ -> channel(HIDDEN) ;
// One statement a line; LF, CR LF and CR (all listings)
EOL : '\r'? '\n' | '\r' ;

// The only word that begins with # (C:30)
HASH_INCLUDE : '#' [ \t]* I N C L U D E ;

// Statement words (C:3-35). Only IF, THEN and NOT are no names elsewhere
KW_IF : I F ;
KW_THEN : T H E N ;
// (U) neither in the vendor's list nor in the editor grammar
KW_ELSE : E L S E ;
KW_FOR : F O R ;
KW_TO : T O ;
KW_STEP : S T E P ;
KW_NEXT : N E X T ;
KW_CONTINUE : C O N T I N U E ;
KW_GOTO : G O T O ;
KW_CALL : C A L L ;
KW_ARGS : A R G S ;
KW_GLOBAL : G L O B A L ;
KW_LOCAL : L O C A L ;
KW_PERMANENT : P E R M A N E N T ;
// Error handler, followed by GOTO (C:2571)
KW_ON_ERROR : O N '_' E R R O R ;
// (U) no evidence of logical operators
KW_AND : A N D ;
KW_OR : O R ;
KW_NOT : N O T ;

// Letter, then letters, digits, underscores (W-lang). One that ends in `_` may be the first half of a word
// with a stray blank, `feed_ x` (T 6.2.4)
OPEN_NAME : NAME_START NAME_PART* '_' ;
ID : NAME_START NAME_PART* ;
// A name of a text ends in `$`, which is part of it (W-lang)
TEXT_NAME : NAME_START NAME_PART* '$' ;

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
// Before or behind the name of a label (T 6.3, C:28)
COLON : ':' ;
// In bare file names only (U)
DOT : '.' ;
BACKSLASH : '\\' ;

// A character of several bytes (UTF-8) that no rule takes
WIDE_CHARACTER : [\u00C2-\u00F4] [\u0080-\u00BF]+ ;
// Anything else: reported by the front end
OTHER : . ;

fragment NAME_START : [a-zA-Z] ;
fragment NAME_PART : [a-zA-Z0-9_] ;
fragment DIGIT : [0-9] ;
fragment EXPONENT : [eE] [+\-]? [0-9]+ ;
fragment A : [aA] ;
fragment B : [bB] ;
fragment C : [cC] ;
fragment D : [dD] ;
fragment E : [eE] ;
fragment F : [fF] ;
fragment G : [gG] ;
fragment H : [hH] ;
fragment I : [iI] ;
fragment L : [lL] ;
fragment M : [mM] ;
fragment N : [nN] ;
fragment O : [oO] ;
fragment P : [pP] ;
fragment R : [rR] ;
fragment S : [sS] ;
fragment T : [tT] ;
fragment U : [uU] ;
fragment X : [xX] ;

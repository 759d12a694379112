// Tokens of the cycle language (docs/cycles.md). Works on bytes. A statement ends with its line: the token
// source (frontend/cycle/Tokens.cpp) hides the line ends within a statement, and names the words.
lexer grammar CycleLexer;

tokens {
  // Words of the language, by a table (frontend/cycle/Tokens.cpp). Those of the second list are words only where
  // an operand cannot begin, and names elsewhere
  KW_CYCLE, KW_OPTIONS, KW_USE, KW_NEEDS, KW_PARAMETER, KW_RESULT, KW_OPTIONAL, KW_REQUIRE, KW_CHOICE, KW_OF, KW_PROBE, KW_SPINDLE,
  KW_COOLANT, KW_ON, KW_OFF, KW_DWELL, KW_STOP, KW_ALARM, KW_REPORT, KW_MOVE, KW_RAPID, KW_FEED, KW_PROTECTED,
  KW_TO, KW_BY, KW_START, KW_HERE, KW_MACHINE, KW_WORK, KW_TOUCH, KW_SET, KW_TOOL, KW_LENGTH, KW_IF, KW_THEN,
  KW_ELSE, KW_END, KW_REPEAT, KW_FOR, KW_WHILE, KW_CALL, KW_GIVEN, KW_IS, KW_NOT, KW_AND, KW_OR,
  KW_FLOOD, KW_MIST, KW_NOMINAL, KW_MEASURED, KW_TOLERANCE, KW_RANGE, KW_GROUP, KW_LETTER, KW_PICTURE,
  KW_RADIUS, KW_LENGTH_WEAR, KW_RADIUS_WEAR, KW_OVERTRAVEL, KW_STORED, KW_ONCE, KW_ALONG, KW_BECOMES, KW_TIMES, KW_STEP, KW_AT, KW_MOST,
  // what a value is: angle, count, ...
  TYPE,
  // x y z a b c
  AXIS,
  // a name of the author's: lower_snake
  NAME,
  // a word with capitals, or with a letter that no name has
  ODD_NAME
}

// to the end of the line; kept
COMMENT : '//' ~[\r\n]* -> channel(HIDDEN) ;
BLANK : [ \t\f\u000B]+ -> skip ;
// ends a statement, but within brackets and after a comma or an operator
NEWLINE : '\r'? '\n' | '\r' ;

// titles and messages
TEXT : '"' ~["\r\n]* '"' ;
// a text that its line does not close, reported
OPEN_TEXT : '"' ~["\r\n]* ;

// a decimal comma directly between digits, reported
COMMA_NUMBER : Digit+ ',' Digit+ ;
NUMBER : Digit+ ('.' Digit*)? | '.' Digit+ ;
UNIT : 'mm/min' | 'in/min' | 'mm' | 'in' | 'deg' | 's' ;

// a work offset by its code
WORK_OFFSET : 'G5' [4-9] | 'G54.1' [ \t]* 'P' [ \t]* Digit+ ;
// a word of G code, reported
CODE : [A-Z] [+-]? Digit+ ('.' Digit*)? | '#' Digit* | 'G' Digit+ '.' Digit+ ;
WORD : [A-Za-z_\u0080-\u00FF] [A-Za-z0-9_\u0080-\u00FF]* ;

ARROW : '->' ;
LESS_EQUAL : '<=' ;
GREATER_EQUAL : '>=' ;
// comparisons of other languages, reported
FOREIGN_EQUAL : '==' | '!=' | '<>' | ':=' | '=<' | '=>' ;
LESS : '<' ;
GREATER : '>' ;
EQUALS : '=' ;
PLUS : '+' ;
MINUS : '-' ;
STAR : '*' ;
SLASH : '/' ;
LPAREN : '(' ;
RPAREN : ')' ;
COMMA : ',' ;
COLON : ':' ;
DOT : '.' ;
// anything else, reported
ANY : . ;

fragment Digit : [0-9] ;

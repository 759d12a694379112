// ComPost `Prog`: structure. The start rule is `item`, run in a loop until the end of the file.
// What is out of place is taken as `stray`, so that one slip costs one statement; the builder reports it.
parser grammar ComPostParser;

options { tokenVocab = ComPostLexer; }

// a Prog is routines and directives in any order (W1, T:3511)
item
  : routine   # routineItem
  | directive # directiveItem
  | loose     # looseItem
  ;

// name: statements RETURN (T:3511-3521)
routine : LABEL danglingTerm* (entry | strayFlow)* KW_RETURN ;

// statements outside a routine: reported
loose : danglingTerm+ looseEntry* | looseEntry+ ;

// a RETURN, ELSE or END here closes nothing
looseEntry : statement danglingTerm* | strayFlow | KW_RETURN danglingTerm* ;

// a directive inside a routine is unverified
block : entry* ;

// one piece of a body
entry : (statement | directive) danglingTerm* ;

// several may appear on a line (T:3833)
statement
  : LITERAL     # literalStatement
  | KW_EOL      # endOfLine
  | word        # wordStatement
  | ifStatement # conditional
  | stray       # strayStatement
  ;

// IF condition ... ELSE ... END (T:3487-3497); a second ELSE is reported
ifStatement : KW_IF condition block elsePart* KW_END ;

// the other branch (T:3487)
elsePart : KW_ELSE danglingTerm* block ;

// chained by AND (T:3890); OR is unverified
condition : term (connective term)* ;

// AND (T:3890), OR (unverified)
connective : KW_AND | KW_OR ;

// NOT is unverified
term : KW_NOT* operand ;

// a boolean keyword (T:3497); brackets are unverified. Nothing at all is reported
operand
  : word                    # wordOperand
  | LPAREN condition RPAREN # bracketOperand
  ;

// a keyword or the name of a routine, with its arguments (W1, T:3513)
word : (NAME | NUMERIC | BOOLEAN) arguments? ;

// ('value') (W1); blanks before the bracket are free (T:3922)
arguments : LPAREN argument? (COMMA argument?)* RPAREN ;

// a text; in FORMAT a keyword or a number (T:3576); anything else is reported
argument
  : LITERAL                                                    # textArgument
  | (UNTERMINATED_LITERAL | TYPOGRAPHIC_TEXT | TYPOGRAPHIC_QUOTE) # brokenArgument
  | unquoted+                                                  # bareArgument
  ;

// a piece of an argument without apostrophes
unquoted
  : NAME | NUMERIC | BOOLEAN | INTEGER | PICTURE_NUMBER | EQUALS | COLON | ODD_CHARACTER | ANY | arguments
  ;

// instructions to the compiler (T:3558-3582)
directive
  : PICTURE_NUMBER EQUALS pictureText # pictureDefinition
  | KW_FORMAT arguments?              # formatDirective
  ;

// the picture; nothing at all is reported
pictureText : LITERAL | UNTERMINATED_LITERAL | TYPOGRAPHIC_TEXT | TYPOGRAPHIC_QUOTE ;

// out of place: reported
stray
  : strayToken  # strayOne
  | KW_NOT term # strayNot
  ;

// AND or OR where no condition is before it: reported
danglingTerm : connective term ;

// a token that begins no statement
strayToken
  : STRAY_LPAREN | RPAREN | COMMA | EQUALS | COLON | INTEGER | UNTERMINATED_LITERAL | TYPOGRAPHIC_TEXT
  | TYPOGRAPHIC_QUOTE | ODD_CHARACTER | ANY
  ;

// ELSE and END without IF: reported
strayFlow : (KW_ELSE | KW_END) danglingTerm* ;

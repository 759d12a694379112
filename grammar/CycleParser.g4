// The cycle language: one statement a line. The start rule is `line`, run in a loop until the end of the file;
// the builder puts the lines of blocks together (docs/cycles.md).
parser grammar CycleParser;

options { tokenVocab = CycleLexer; }

// the token source ends the last line too
line : statement? NEWLINE ;

statement
  : (KW_CYCLE | KW_OPTIONS) name text?                                          # header
  | KW_USE name                                                                 # use
  | KW_NEEDS KW_PROBE                                                           # needs
  | KW_PARAMETER names COLON type KW_OPTIONAL? initial? text? clause*           # parameter
  | KW_RESULT names COLON type text?                                            # result
  | KW_REQUIRE expression text?                                                 # require
  | KW_PROBE (KW_ON | KW_OFF)                                                   # probe
  | KW_SPINDLE KW_OFF                                                           # spindle
  | KW_COOLANT (KW_OFF | KW_FLOOD | KW_MIST)                                    # coolant
  | KW_DWELL expression                                                         # dwell
  | KW_STOP text                                                                # stop
  | KW_ALARM text                                                               # alarm
  | KW_REPORT text (KW_NOMINAL expression)? KW_MEASURED expression (KW_TOLERANCE expression)? # report
  | moveKind? KW_MOVE (KW_TO KW_START | reach coordinates) (KW_FEED expression)? # move
  | KW_TOUCH KW_ONCE? touchAxis reach expression (KW_OVERTRAVEL expression)? (ARROW name)? KW_ELSE? # touch
  | KW_SET KW_TOOL expression toolPart expression                               # setTool
  | KW_SET KW_STORED name expression                                            # setStored
  | KW_SET expression COLON becomes (COMMA becomes)*                            # setOffset
  | KW_IF expression KW_THEN                                                    # ifLine
  | KW_ELSE KW_IF expression KW_THEN                                            # elseIfLine
  | KW_ELSE                                                                     # elseLine
  | KW_END                                                                      # endLine
  | KW_REPEAT expression KW_TIMES                                               # repeatLine
  | KW_FOR name EQUALS expression KW_TO expression (KW_STEP expression)?        # forLine
  | KW_WHILE expression KW_AT KW_MOST expression KW_TIMES                       # whileLine
  | KW_CALL name (argument (COMMA argument)*)? (ARROW name)?                    # call
  | NAME EQUALS expression                                                      # assign
  ;

toolPart : KW_LENGTH | KW_RADIUS | KW_LENGTH_WEAR | KW_RADIUS_WEAR ;
moveKind : KW_RAPID | KW_FEED | KW_PROTECTED ;
// `to` a coordinate, `by` a distance from here
reach : KW_TO | KW_BY ;
// one axis, or a direction by its parts
touchAxis : AXIS | KW_ALONG coordinates ;
coordinates : coordinate (COMMA coordinate)* ;
// in the active work offset where nothing else is said
coordinate : (KW_MACHINE | KW_WORK primary)? AXIS expression ;
becomes : expression KW_BECOMES AXIS expression ;
// `use NAME` hands on options
argument : NAME EQUALS expression | KW_USE name ;

names : name (COMMA name)* ;
// a reserved word is reported
name : NAME | ODD_NAME | AXIS | UNIT | TYPE | CODE | word ;
word
  : KW_CYCLE | KW_OPTIONS | KW_USE | KW_NEEDS | KW_PARAMETER | KW_RESULT | KW_OPTIONAL | KW_REQUIRE | KW_CHOICE | KW_OF | KW_PROBE
  | KW_SPINDLE | KW_COOLANT | KW_ON | KW_OFF | KW_DWELL | KW_STOP | KW_ALARM | KW_REPORT | KW_MOVE | KW_RAPID
  | KW_FEED | KW_PROTECTED | KW_BY | KW_START | KW_HERE | KW_MACHINE | KW_WORK | KW_TOUCH | KW_SET | KW_TOOL
  | KW_LENGTH | KW_IF | KW_REPEAT | KW_FOR | KW_WHILE | KW_CALL | KW_GIVEN | KW_IS
  ;
type : TYPE | KW_LENGTH | KW_FEED | KW_CHOICE KW_OF choiceName (COMMA choiceName)* | NAME | UNIT ;
choiceName : NAME | ODD_NAME | AXIS ;
initial : EQUALS expression ;
clause
  : KW_REQUIRE expression text?      # requireClause
  | KW_RANGE expression KW_TO expression # rangeClause
  | KW_GROUP text                    # groupClause
  | KW_LETTER (ODD_NAME | NAME | AXIS | UNIT) # letterClause
  | KW_PICTURE text                  # pictureClause
  ;
text : TEXT | OPEN_TEXT ;

expression : conjunction (KW_OR conjunction)* ;
conjunction : negation (KW_AND negation)* ;
negation : KW_NOT negation | comparison ;
comparison : sum (comparator sum)? ;
comparator : LESS | LESS_EQUAL | GREATER | GREATER_EQUAL | KW_IS KW_NOT? | EQUALS | FOREIGN_EQUAL ;
sum : product ((PLUS | MINUS) product)* ;
product : factor ((STAR | SLASH) factor)* ;
factor : (PLUS | MINUS) factor | primary ;
primary
  : (NUMBER | COMMA_NUMBER) UNIT?                         # number
  | WORK_OFFSET                                           # workOffset
  | TEXT                                                  # textValue
  | KW_GIVEN name                                         # given
  | NAME LPAREN (expression (COMMA expression)*)? RPAREN  # function
  | object (DOT member)?                                  # nameUse
  | LPAREN expression RPAREN                              # bracketed
  ;
object : NAME | KW_START | KW_HERE ;
// whatever word follows a point is a NAME
member : NAME ;

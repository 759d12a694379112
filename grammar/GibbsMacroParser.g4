// Lines of the GibbsCAM macro language. One start rule a kind of file, run line by line: `line` for .mac,
// `controlLine` for .dlg, `definitionLine` for DefineData.txt. Blocks of several lines (IF ... [ ... ],
// CONTOUR, FOR ... NEXT) are put together by the front end. Every decision takes one token: what a word is at its
// place was decided before (NAME, COMMAND, ... in GibbsMacroLexer.g4). Sources as there.
parser grammar GibbsMacroParser;
options { tokenVocab = GibbsMacroLexer; }

// ---- .mac ----

// One statement a line (all listings); blank lines anywhere (M1, M2)
line : lineContent? lineEnd ;
// The last line may lack its end
lineEnd : EOL | EOF ;

lineContent
    : label oneLine?                                # labelled
    | oneLine                                       # plain
    | LEFT_SQUARE                                   # blockOpen
    | RIGHT_SQUARE (KW_ELSE elsePart?)?             # blockClose
    | KW_ELSE elsePart?                             # elseLine
    ;

// A label is alone (C:28); a statement after it is accepted and reported
// Leading colon (T 6.3), colon after the name (C:28)
label : COLON LABEL_NAME | LABEL_NAME COLON ;

// ELSE on the line of its IF (U) belongs to the nearest IF before it
oneLine : statement (KW_ELSE statement)* ;
// (U) what may follow ELSE
elsePart : LEFT_SQUARE | oneLine ;

statement
    : assignment | ifStatement | forStatement | nextStatement | continueStatement | gotoStatement
    | callStatement | argsStatement | declaration | includeStatement | onErrorStatement | command
    ;

// variable = expression (M1, M2, T)
assignment : variable EQUAL sum ;
// IF value relation value THEN statement (C:14-16); a comma before THEN (T 6.3); nothing or `[` after THEN (U)
ifStatement : KW_IF condition COMMA? KW_THEN (LEFT_SQUARE | statement)? ;
// FOR variable = start TO end [STEP value] (C:18-22)
forStatement : KW_FOR NAME EQUAL sum KW_TO sum (KW_STEP sum)? ;
// NEXT variable (C:18-22); without a variable (U)
nextStatement : KW_NEXT NAME? ;
// Steps and tests, as NEXT does (C:22)
continueStatement : KW_CONTINUE ;
// GOTO label (C:25)
gotoStatement : KW_GOTO NAME ;
// CALL macro, up to 10 values (C:26-28); how the macro is written (U)
callStatement : KW_CALL COMMA? (sum | bareFile) (COMMA sum)* ;
// Names that receive the values of CALL, at most 50 (C:9-11)
argsStatement : KW_ARGS COMMA? variable (COMMA variable)* ;
// GLOBAL, LOCAL, PERMANENT with at most 50 names (C:3-8); a number of elements (U)
declaration : (KW_GLOBAL | KW_LOCAL | KW_PERMANENT) COMMA? variable (COMMA variable)* ;
// #INCLUDE file (C:30-34); its quoting (U)
includeStatement : HASH_INCLUDE (textLiteral | bareFile) ;
// ON_ERROR GOTO label (C:2571)
onErrorStatement : KW_ON_ERROR KW_GOTO NAME ;
// Command word, arguments separated by commas (M1, M2, T); a comma after the word (M2)
command : COMMAND COMMA? (sum (COMMA sum)*)? ;

// A file name without quotes: words, numbers, `-` and, between them, `.`, `\`, `:` (U)
bareFile : FILE_PART+ ;

// ---- expressions ----

// Comparisons joined by AND and OR (U)
condition : comparison ((KW_AND | KW_OR) comparison)* ;
// One comparison (C:14-16); NOT and brackets around a comparison (U)
comparison
    : sum relation sum                              # plainComparison
    | KW_NOT comparison                             # negatedComparison
    | CONDITION_ROUND comparison RIGHT_ROUND        # bracketedComparison
    ;
// Relations (T, G)
relation : EQUAL | NOT_EQUAL | LESS | GREATER | LESS_EQUAL | GREATER_EQUAL ;

// Left to right (T 6.4); `+` joins texts (U)
sum : product ((PLUS | MINUS) product)* ;
// Binds tighter than a sum (W-lang)
product : factor ((STAR | SLASH) factor)* ;
// A value, or a sign before one (T 6.5)
factor
    : (PLUS | MINUS) factor                         # signedValue
    | NUMBER                                        # numberValue
    | textLiteral                                   # textValue
    | NAME arguments?                               # nameValue
    | LEFT_ROUND sum RIGHT_ROUND                    # bracketValue
    ;

// Double quotes (W-lang), single quotes (U; G)
textLiteral : TEXT | SINGLE_TEXT ;
// Of a function (C:39), or the index of an array, which has no proven spelling (U)
arguments : LEFT_ROUND (sum (COMMA sum)*)? RIGHT_ROUND | LEFT_SQUARE sum RIGHT_SQUARE ;
// A variable, numbers and texts (W-lang), or an element of an array (U)
variable : NAME index? ;
// The index of an array (U)
index : LEFT_ROUND sum RIGHT_ROUND | LEFT_SQUARE sum RIGHT_SQUARE ;

// ---- .dlg ----

// One control a line (T 6.2.2)
controlLine : control? lineEnd ;
// Control word, arguments (C:2765-2801)
control : COMMAND COMMA? (controlArgument (COMMA controlArgument)*)? ;
// SET_STATE takes a condition (C:2795); FRAME once is with an unquoted caption (T 6.2.2)
controlArgument
    : sum (relation sum)?                           # valueArgument
    | LOOSE_TEXT+                                   # looseText
    ;

// ---- DefineData.txt ----

// One definition a line (T 6.2.1)
definitionLine : definition? lineEnd ;
// NAME = number (T 6.2.1); texts and expressions (U)
definition : variable EQUAL sum ;

// Lines of the GibbsCAM macro language. One start rule a kind of file, run line by line: `line` for .mac,
// `controlLine` for .dlg, `definitionLine` for DefineData.txt. Blocks of several lines (IF ... [ ... ],
// CONTOUR, FOR ... NEXT) are put together by the front end. Sources as in GibbsMacroLexer.g4.
parser grammar GibbsMacroParser;
options { tokenVocab = GibbsMacroLexer; }

// ---- .mac ----

// One statement a line (all listings); blank lines anywhere (M1, M2)
line : lineContent? EOL | lineContent EOF ;

lineContent
    : label oneLine?                                # labelled
    | oneLine                                       # plain
    | LEFT_SQUARE                                   # blockOpen
    | RIGHT_SQUARE (KW_ELSE elsePart?)?             # blockClose
    | KW_ELSE elsePart?                             # elseLine
    ;

// A label stands alone (C:28); a statement behind it is accepted and reported
// Leading colon (T 6.3), colon behind the name (C:28)
label : COLON name | name COLON ;

// ELSE on the line of its IF (U) belongs to the nearest IF before it
oneLine : statement (KW_ELSE statement)* ;
// (U) what may stand behind ELSE
elsePart : LEFT_SQUARE | oneLine ;

statement
    : assignment | ifStatement | forStatement | nextStatement | continueStatement | gotoStatement
    | callStatement | argsStatement | declaration | includeStatement | onErrorStatement | command
    ;

// variable = expression (M1, M2, T)
assignment : variable EQUAL sum ;
// IF value relation value THEN statement (C:14-16); a comma before THEN (T 6.3); nothing or `[` behind THEN (U)
ifStatement : KW_IF condition COMMA? KW_THEN (LEFT_SQUARE | statement)? ;
// FOR variable = start TO end [STEP value] (C:18-22)
forStatement : KW_FOR name EQUAL sum KW_TO sum (KW_STEP sum)? ;
// NEXT variable (C:18-22); without a variable (U)
nextStatement : KW_NEXT name? ;
// Steps and tests, as NEXT does (C:22)
continueStatement : KW_CONTINUE ;
// GOTO label (C:25)
gotoStatement : KW_GOTO name ;
// CALL macro, up to 10 values (C:26-28); how the macro is written (U)
callStatement : KW_CALL COMMA? (sum | bareFile) (COMMA sum)* ;
// Names that receive the values of CALL, at most 50 (C:9-11)
argsStatement : KW_ARGS COMMA? variable (COMMA variable)* ;
// GLOBAL, LOCAL, PERMANENT with at most 50 names (C:3-8); a number of elements (U)
declaration : (KW_GLOBAL | KW_LOCAL | KW_PERMANENT) COMMA? variable (COMMA variable)* ;
// #INCLUDE file (C:30-34); its quoting (U)
includeStatement : HASH_INCLUDE (textLiteral | fileWord | bareFile) ;
// ON_ERROR GOTO label (C:2571)
onErrorStatement : KW_ON_ERROR KW_GOTO name ;
// Command word, arguments separated by commas (M1, M2, T); a comma behind the word (M2)
command : commandName COMMA? (sum (COMMA sum)*)? ;

// A file name without quotes (U)
bareFile : fileWord (fileSeparator fileWord?)+ | (fileSeparator fileWord?)+ ;
// Stretch of a bare file name
fileWord : (name | NUMBER | MINUS)+ ;
// What splits a bare file name
fileSeparator : DOT | BACKSLASH | COLON ;

// ---- expressions ----

// Comparisons joined by AND and OR (U)
condition : comparison ((KW_AND | KW_OR) comparison)* ;
// One comparison (C:14-16); NOT and brackets around a comparison (U)
comparison
    : sum relation sum                              # plainComparison
    | KW_NOT comparison                             # negatedComparison
    | LEFT_ROUND comparison RIGHT_ROUND             # bracketedComparison
    ;
// Relations (T, G)
relation : EQUAL | NOT_EQUAL | LESS | GREATER | LESS_EQUAL | GREATER_EQUAL ;

// Left to right (T 6.4); `+` joins texts (U)
sum : product ((PLUS | MINUS) product)* ;
// Binds tighter than a sum (W-lang)
product : factor ((STAR | SLASH) factor)* ;
// A sign before a value (T 6.5)
factor : (PLUS | MINUS) factor | primary ;

primary
    : NUMBER                                        # numberValue
    | textLiteral                                   # textValue
    | variableName                                  # plainValue
    | variableName LEFT_ROUND (sum (COMMA sum)*)? RIGHT_ROUND # callValue
    | variableName LEFT_SQUARE sum RIGHT_SQUARE     # elementValue
    | LEFT_ROUND sum RIGHT_ROUND                    # bracketValue
    ;

// Double quotes (W-lang), single quotes (U; G)
textLiteral : TEXT | SINGLE_TEXT ;
// A variable, or an element of an array, whose index has no proven spelling (U)
variable : variableName (LEFT_ROUND sum RIGHT_ROUND | LEFT_SQUARE sum RIGHT_SQUARE)? ;
// Numbers, and texts by the final `$` (W-lang)
variableName : name | OPEN_NAME* TEXT_NAME ;
// There are no reserved words: the place decides (reference 2.2)
name
    : commandName | OPEN_NAME
    | KW_ELSE | KW_FOR | KW_TO | KW_STEP | KW_NEXT | KW_CONTINUE | KW_GOTO | KW_CALL | KW_ARGS | KW_GLOBAL
    | KW_LOCAL | KW_PERMANENT | KW_ON_ERROR | KW_AND | KW_OR
    ;
// One word; a blank behind its `_` is a slip that is accepted and reported (T 6.2.4)
commandName : OPEN_NAME* ID ;

// ---- .dlg ----

// One control a line (T 6.2.2)
controlLine : control? EOL | control EOF ;
// Control word, arguments (C:2765-2801)
control : name COMMA? (controlArgument (COMMA controlArgument)*)? ;
// SET_STATE takes a condition (C:2795); FRAME once stands with an unquoted caption (T 6.2.2)
controlArgument
    : sum                                           # valueArgument
    | sum relation sum                              # conditionArgument
    | name (name | NUMBER)+                         # looseText
    ;

// ---- DefineData.txt ----

// One definition a line (T 6.2.1)
definitionLine : definition? EOL | definition EOF ;
// NAME = number (T 6.2.1); texts and expressions (U)
definition : variable EQUAL sum ;

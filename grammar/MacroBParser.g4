// Fanuc custom macro B: one block. The start rule is `block`, run once for each block, so that a bad one costs
// one error. Every decision takes one token. What the grammar takes and the language does not (a comparison where
// a number is needed, say) is reported by the builder. Sources as in MacroBLexer.g4.
parser grammar MacroBParser;
options { tokenVocab = MacroBLexer; }

// /n N5 statement (R:1.1)
block : blockDelete? sequenceNumber? statement? end ;
// the last block may lack its end
end : EOL | EOF ;
// optional block, switch 1 to 9 (R:1.1)
blockDelete : SLASH NUMBER? ;
// N5 (R:1.1)
sequenceNumber : ADDRESS_N NUMBER ;

// one of them a block (R:1.2)
statement
  : words
  | assignment
  | ifStatement
  | whileStatement
  | doStatement
  | endStatement
  | gotoStatement
  | printStatement
  | portStatement
  | nameStatement
  ;

// NC statement, macro calls too: G65 P9811 Y-1. (R:1.2, R:1.8)
words : ADDRESS wordValue word* ;
word : (ADDRESS | ADDRESS_N) wordValue ;
// X5. X#1 X-#1 X[#1+2.] (R:1.1)
wordValue : sign? (NUMBER | variable | bracket) ;
sign : PLUS | MINUS ;

// #1=#2+1 (R:1.2)
assignment : variable EQUALS comparison ;
// IF [..] GOTO n, IF [..] THEN statement; THEN GOTO n ran on a 31i-B (R:1.7, T31)
ifStatement : KW_IF bracket (gotoStatement | KW_THEN thenStatement) ;
// one macro statement (R:1.7, ZH); words are taken and reported
thenStatement : assignment | gotoStatement | printStatement | portStatement | nameStatement | words ;
// WHILE [..] DO m (R:1.7)
whileStatement : KW_WHILE bracket doStatement ;
// DO m; a missing number is reported by the checks (R:1.7)
doStatement : KW_DO NUMBER? ;
// END m (R:1.7)
endStatement : KW_END NUMBER? ;
// GOTO 100, GOTO #1, GOTO [..] (R:1.7)
gotoStatement : KW_GOTO wordValue ;
// DPRNT[X#100[53]], BPRNT[..] (R:1.9)
printStatement : PRINT PRINT_TEXT ;
// POPEN, PCLOS (R:1.9)
portStatement : PORT ;
// SETVN 510[NAME,NAME] (R:1.9)
nameStatement : KW_SETVN NUMBER PRINT_TEXT ;

// brackets around a number or around a condition (R:1.4)
bracket : LBRACKET comparison RBRACKET ;
// EQ NE GT GE LT LE, in conditions only (R:1.4)
comparison : sum (RELATION sum)? ;
// lowest of the operators (R:1.4)
sum : product ((PLUS | MINUS | KW_OR | KW_XOR) product)* ;
// binds tighter than a sum (R:1.4)
product : factor ((STAR | SLASH | KW_AND | KW_MOD) factor)* ;
factor
  : sign factor  # signedFactor
  | NUMBER       # numberFactor
  | variable     # variableFactor
  | function     # functionFactor
  | bracket      # bracketFactor
  ;
// #5, #[..] (R:1.1)
variable : HASH (NUMBER | bracket) ;
// SIN[..], ATAN[y]/[x] and ATAN[y,x]; ABS#1 is in programs that ran (R:1.5, T31)
function : FUNCTION (LBRACKET comparison (COMMA comparison)? RBRACKET | variable) ;

lexer grammar ComPostLexer;
ANY : . ;

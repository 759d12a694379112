lexer grammar GibbsMacroLexer;
ANY : . ;

parser grammar GibbsMacroParser;
options { tokenVocab = GibbsMacroLexer; }
item : ANY ;

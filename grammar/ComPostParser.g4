parser grammar ComPostParser;
options { tokenVocab = ComPostLexer; }
item : ANY ;

%
O0001
(DOTEK: IGNORE ASSIGNED-TO-ITSELF)
#501=#501
N10 GOTO10 (dotek: ignore assigned-to-itself)
M30
%

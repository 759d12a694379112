O0007
N10 G0 X10. Y0
N20 G2 X0 Y-10.5 I-10. F100 (off its circle)
N30 M30

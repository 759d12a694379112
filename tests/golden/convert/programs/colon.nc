:500(Mìstek)
N1(ìn)G1X#1F100
#3=1
M30

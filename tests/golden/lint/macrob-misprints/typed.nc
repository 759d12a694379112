:70
(TYPED FROM A LISTING)
B #2 = wall angle
GO G90 X-12,5 YO.
#120 = 8. + #[2000 + #7]
D02
#121 = [#120 - 3.] / SIN [#2]
G1 X [#121 - #3] / [#120] F #9
IF [#121 GT 40.] GOTO 30
Z [[#120 - #121] * 2. F #9
END 2
N 30 G0 Z 60.
M99

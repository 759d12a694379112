G0 X1. (never
X2.

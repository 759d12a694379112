%
O9101(bore 3)
g1x10.y[#1+2*[#3-1]]f100(to the edge)

n10 if[#1eq#0]then#3000=1(NO A)
/ g0 z5.
while[#2lt3]do1
#2=#2+1
end1
m99
%

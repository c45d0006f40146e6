; expect: 6:8: 'glTable' takes 1 index, found 2; write glTable[index]
; expect: 7:1: 'glTable' is an array and needs an index
; expect: 8:19: unexpected '['
; expect: 9:9: 'ddlQuote' takes 2 indexes, found 1; write ddlQuote[recipe, step]

glTable[1, 2] = 5
glTable = 5
slLength = gbPhase[1]
ddlQuote[1] = 3
END

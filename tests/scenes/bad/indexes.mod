; expect: 9:8: 'glTable' takes 1 index, found 2; write glTable[index]
; expect: 10:1: 'glTable' is an array and needs an index
; expect: 11:19: unexpected '['
; expect: 12:9: 'ddlQuote' takes 2 indexes, found 1; write ddlQuote[recipe, step]
; expect: 13:10: recipe 6 is outside 1..5 of 'ddlQuote'
; expect: 13:13: step 9 is outside 1..8 of 'ddlQuote'
; expect: 13:26: index 11 is outside 1..10 of 'glTable'

glTable[1, 2] = 5
glTable = 5
slLength = gbPhase[1]
ddlQuote[1] = 3
ddlQuote[6, 9] = glTable[11]
END

; expect: 9:8: qcl.type
; expect: 10:1: qcl.type
; expect: 11:19: qcl.syntax
; expect: 12:9: qcl.type
; expect: 13:10: qcl.out-of-range
; expect: 13:13: qcl.out-of-range
; expect: 13:26: qcl.out-of-range

glTable[1, 2] = 5
glTable = 5
slLength = gbPhase[1]
ddlQuote[1] = 3
ddlQuote[6, 9] = glTable[11]
END

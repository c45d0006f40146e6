; expect: 5:1: qcl.unknown-name
; expect: 6:7: qcl.unknown-name
; expect: 7:10: qcl.unknown-name
; expect: 8:1: qcl.unknown-name
slLenght = 5
AxisX:possit = 0
WAIT NOT AxisY:st_init
INITT AxisX
END

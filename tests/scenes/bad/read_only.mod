; expect: 6:1: qcl.not-writable
; expect: 7:1: qcl.not-writable
; expect: 8:7: qcl.not-writable
; expect: 9:7: qcl.not-writable

cLimit = 5
ifStart = 1
AxisX:st_init = 1
AxisX:rowex = 3
END

; expect: 5:15: qcl.syntax
; expect: 6:12: qcl.syntax
; expect: 7:12: qcl.syntax
; expect: 9:9: qcl.syntax
slLength = 5 +
slLength = * 5
IF gbPhase = 1
ENDIF
gbPhase 7
END

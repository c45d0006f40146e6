; expect: 5:15: missing operand at the end of the line
; expect: 6:12: missing operand before '*'
; expect: 7:12: unexpected '='; EQ compares
; expect: 9:9: expected '=' after 'gbPhase', found '7'
slLength = 5 +
slLength = * 5
IF gbPhase = 1
ENDIF
gbPhase 7
END

; expect: 4:1: qcl.block
; expect: 8:1: qcl.block

IF gbPhase EQ 1
  slLength = 5
  WAIT 1

ENDWHILE
END

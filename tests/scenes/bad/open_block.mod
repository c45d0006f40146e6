; expect: 4:1: IF without ENDIF
; expect: 8:1: ENDWHILE without WHILE

IF gbPhase EQ 1
  slLength = 5
  WAIT 1

ENDWHILE
END

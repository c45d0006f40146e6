; expect: 5:1: QCL has no ELSEIF; write ELSE, and an IF with an ENDIF of its own in it

IF gbPhase EQ 1
  slLength = 5
ELSEIF gbPhase EQ 2
  slLength = 6
ENDIF
END

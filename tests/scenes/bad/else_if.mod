; expect: 5:1: qcl.unknown-name

IF gbPhase EQ 1
  slLength = 5
ELSEIF gbPhase EQ 2
  slLength = 6
ENDIF
END

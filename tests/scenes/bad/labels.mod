; expect: 5:1: qcl.twice
; expect: 6:6: qcl.unknown-name
MAIN:
WAIT 1
MAIN:
JUMP MAIM
END

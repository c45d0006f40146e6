; expect: 5:1: the label 'MAIN' stands twice
; expect: 6:6: unknown label 'MAIM'; did you mean 'MAIN'?
MAIN:
WAIT 1
MAIN:
JUMP MAIM
END

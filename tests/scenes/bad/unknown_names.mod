; expect: 5:1: unknown name 'slLenght'; did you mean 'slLength'?
; expect: 6:7: CAMMING4 has no parameter or state 'possit'; did you mean 'posit'?
; expect: 7:10: unknown device 'AxisY'; did you mean 'AxisX'?
; expect: 8:1: CAMMING4 has no command 'INITT'; did you mean 'INIT'?
slLenght = 5
AxisX:possit = 0
WAIT NOT AxisY:st_init
INITT AxisX
END

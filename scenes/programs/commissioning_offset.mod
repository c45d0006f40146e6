;-----
; Offset: with 0 V the axis must stand. The program measures how far it creeps in 300 ms and corrects, without
; end: what drifts is followed. See commissioning.cnf. gbStep: 0 creeps, 1 the first correction is made
;-----
;-----
; Set-up of the axis: screw lead 20 mm, 2500 lines a turn of the motor
;-----
Axis:cntratio = 80000
Axis:decpt    = 2
Axis:unitvel  = 0                 ; speeds in mm/min
Axis:maxvel   = 40000             ; theoretical: 2000 rpm at 10 V, 20 mm a turn
Axis:minpos   = 0
Axis:maxpos   = 100000
Axis:maxfollerr = 2000
Axis:rampmode = 0
Axis:taccdec  = 100               ; 1 s from rest to maxvel
Axis:rtype    = 1
Axis:toll     = 3
Axis:feedfw   = 1000

INIT Axis
WAIT Axis:st_init
CNTUNLOCK Axis
WAIT NOT Axis:st_cntlock
CNTDIR Axis
WAIT NOT Axis:st_cntrev
REGON Axis
WAIT NOT Axis:st_regoff
CALON Axis
WAIT Axis:st_cal
Axis:vout = 0
tmRest = 1000                     ; let it be seen
WAIT tmRest

;-----
; 0.01 mm in 300 ms is 2 mm/min, at 40000 mm/min for 32767 bits: 5/3 of a bit
;-----
MAIN:
glBefore = Axis:posit
tmRest = 300
WAIT tmRest
Axis:offset = Axis:offset - (Axis:posit - glBefore) * 5 / 3
tmRest = 50
WAIT tmRest
gbStep = 1
JUMP MAIN
END

;-----
; Calibration of the output: maxvel by the practical method, with a part of the voltage and with all of it.
; See commissioning.cnf. gbStep: 1 at 2 V, 2 at 10 V, 3 at -10 V, 4 maxvel found, 5 at rest
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

gbStep = 1
Axis:vout = 20
tmRest = 600                      ; two windows of the frequency meter and the drive's run-up
WAIT tmRest
glPart = Axis:vel * 100 / 20
gbStep = 2
Axis:vout = 100
tmRest = 600
WAIT tmRest
glFull = Axis:vel
gbStep = 3
Axis:vout = - 100
tmRest = 650
WAIT tmRest
glBack = Axis:vel
Axis:vout = 0
Axis:maxvel = (glFull + glBack) / 2
WAIT Axis:maxvel EQ (glFull + glBack) / 2
gbStep = 4
tmRest = 400
WAIT tmRest
CALOFF Axis
WAIT NOT Axis:st_cal
gbStep = 5
END

;-----
; Positioning across the backlash with the encoder on the motor: the device does not see the gap.
; The same quota from below, from above and from below again. See commissioning.cnf.
; gbStep: 1 from below, 2 there, 3 beyond it, 4 from above, 5 there, 6 below it, 7 from below, 8 there
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
Axis:setvel   = 6000
IF Axis:pgain EQ 0                ; gains, unless the commissioning has set them
    Axis:pgain  = 100
    Axis:feedfw = 1000
ENDIF

INIT Axis
WAIT Axis:st_init
CNTUNLOCK Axis
WAIT NOT Axis:st_cntlock
CNTDIR Axis
WAIT NOT Axis:st_cntrev
REGON Axis
WAIT NOT Axis:st_regoff
Axis:posit = 10000                ; where the load stands
LOOPON Axis
WAIT Axis:st_loopon

gbStep = 1
Axis:setpos = 15000
CALL Go
gbStep = 2
tmRest = 200
WAIT tmRest
gbStep = 3
Axis:setpos = 18000
CALL Go
gbStep = 4
Axis:setpos = 15000
CALL Go
gbStep = 5
tmRest = 200
WAIT tmRest
gbStep = 6
Axis:setpos = 12000
CALL Go
gbStep = 7
Axis:setpos = 15000
CALL Go
gbStep = 8
END

SUB Go
    START Axis
    WAIT NOT Axis:st_still
    WAIT Axis:st_still
    tmRest = 400
    WAIT tmRest
ENDSUB

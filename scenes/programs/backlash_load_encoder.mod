;-----
; Positioning across the backlash with the scale on the load: the gap is inside the loop.
; The same quota from below and from above. See commissioning.cnf.
; gbStep: 1 from below, 2 there, 3 beyond it, 4 from above, 5 there
;-----
;-----
; Set-up of the axis: linear scale on the load, 0.004 mm a line
;-----
Axis:cntratio = 40000
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
    Axis:pgain  = 30
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
CALL Settle
gbStep = 2
tmRest = 200
WAIT tmRest
gbStep = 3
Axis:setpos = 18000
CALL Go
gbStep = 4
Axis:setpos = 15000
CALL Go
CALL Settle
gbStep = 5
END

;-----
; The load has run on a little with the guides' friction alone; to bring it back the motor has to cross the
; gap, at the speed that the gain makes of that little
;-----
SUB Settle
    tmRest = 1200
    WAIT tmRest
ENDSUB

SUB Go
    START Axis
    WAIT NOT Axis:st_still
    WAIT Axis:st_still
    tmRest = 400
    WAIT tmRest
ENDSUB

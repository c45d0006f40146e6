;-----
; The axis with play inside the loop (scale on the load) stands and regulates, at a gain 20 % below the one
; from which `drycut bode --limit-cycle` predicts an oscillation, then 20 % above it. See commissioning.cnf.
; gbStep: 1 lower gain, disturbed, 2 at rest again?, 3 higher gain, disturbed, 4 at rest again?
;-----
Axis:cntratio = 40000             ; linear scale on the load, 0.004 mm a line
Axis:decpt    = 2
Axis:unitvel  = 0                 ; speeds in mm/min
Axis:maxvel   = 40000             ; theoretical: 2000 rpm at 10 V, 20 mm a turn
Axis:minpos   = 0
Axis:maxpos   = 100000
Axis:maxfollerr = 30000
Axis:rampmode = 0
Axis:taccdec  = 100               ; 1 s from rest to maxvel
Axis:rtype    = 1
Axis:toll     = 3
Axis:setvel   = 6000
Axis:feedfw   = 1000
Axis:pgain    = 127

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
tmRest = 2000
WAIT tmRest
gbStep = 2
tmRest = 500
WAIT tmRest
Axis:pgain = 191
gbStep = 3
tmRest = 2000
WAIT tmRest
gbStep = 4
END

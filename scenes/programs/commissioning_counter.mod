;-----
; Counter check: a small positive voltage has to make the count rise. See commissioning.cnf.
; gbStep: 1 first jog, 2 the count is right, 3 forward, 4 backward, 5 at rest, done
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
Axis:posit = 0
CALON Axis
WAIT Axis:st_cal

;-----
; Half a volt, half a second
;-----
gbStep = 1
Axis:vout = 5
tmRest = 500
WAIT tmRest
Axis:vout = 0
tmRest = 300
WAIT tmRest
IF Axis:posit LT 0
    CNTREV Axis                   ; the transducer's phases are the wrong way round
    WAIT Axis:st_cntrev
    Axis:posit = - Axis:posit     ; what the ruler on the machine says
    WAIT Axis:posit GE 0
ENDIF

;-----
; Both directions: the count follows the machine
;-----
gbStep = 3
Axis:vout = 5
tmRest = 700
WAIT tmRest
gbStep = 4
Axis:vout = - 5
tmRest = 700
WAIT tmRest
Axis:vout = 0
tmRest = 300
WAIT tmRest
gbStep = 5
CALOFF Axis
END

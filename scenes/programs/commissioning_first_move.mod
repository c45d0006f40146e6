;-----
; First move: feed-forward only, then with proportional gain. maxvel is the name plate's, the drive was set
; two per cent slower. See commissioning.cnf.
; gbStep: 1 first move, 2 arrived somewhere, 3 with gain, 4 arrived, 5 back with gain, 6 arrived
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
Axis:setvel   = 12000
Axis:pgain    = 0

INIT Axis
WAIT Axis:st_init
CNTUNLOCK Axis
WAIT NOT Axis:st_cntlock
CNTDIR Axis
WAIT NOT Axis:st_cntrev
REGON Axis
WAIT NOT Axis:st_regoff
Axis:posit = 10000                ; where the ruler says it stands

gbStep = 1
Axis:setpos = 30000
START Axis
WAIT NOT Axis:st_still
WAIT Axis:st_still
tmRest = 200
WAIT tmRest
gbStep = 2
tmRest = 200
WAIT tmRest

;-----
; The same quota again, now the position counts
;-----
Axis:pgain = 100
LOOPON Axis
WAIT Axis:st_loopon
gbStep = 3
START Axis
WAIT NOT Axis:st_still
WAIT Axis:st_still
tmRest = 300
WAIT tmRest
gbStep = 4
tmRest = 200
WAIT tmRest
gbStep = 5
Axis:setpos = 10000
START Axis
WAIT NOT Axis:st_still
WAIT Axis:st_still
tmRest = 300
WAIT tmRest
gbStep = 6
END

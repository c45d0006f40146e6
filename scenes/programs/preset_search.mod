;-----
; Preset search on a real switch: what its filter costs in mode 0, and why mode 1 does not care.
; See commissioning.cnf. gbStep: 1, 3, 5 searching; 2 found in mode 0 at 1200 mm/min, 4 in mode 0 at 300 mm/min,
; 6 in mode 1
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
Axis:prsvel   = 6000
Axis:prsdir   = 1                 ; the switch is behind the axis
Axis:pgain    = 100

INIT Axis
WAIT Axis:st_init
CNTUNLOCK Axis
WAIT NOT Axis:st_cntlock
CNTDIR Axis
WAIT NOT Axis:st_cntrev
REGON Axis
WAIT NOT Axis:st_regoff
LOOPON Axis
WAIT Axis:st_loopon

gbStep = 1
Axis:prsmode  = 0
Axis:prspos   = 1050              ; where the switch lets go
Axis:sprsvel  = 1200
CALL Search
gbStep = 2
tmRest = 100
WAIT tmRest
gbStep = 3
CALL Away
Axis:sprsvel  = 300
CALL Search
gbStep = 4
tmRest = 100
WAIT tmRest
gbStep = 5
CALL Away
Axis:prsmode  = 1
Axis:prspos   = 2000              ; the zero pulse behind the switch
Axis:sprsvel  = 1200
CALL Search
gbStep = 6
END

SUB Search
    PRESET Axis
    WAIT Axis:st_prson
    WAIT Axis:st_prsok
    WAIT Axis:st_still
    tmRest = 200
    WAIT tmRest
ENDSUB

SUB Away
    Axis:setvel = 6000
    Axis:setpos = 4000
    START Axis
    WAIT NOT Axis:st_still
    WAIT Axis:st_still
ENDSUB

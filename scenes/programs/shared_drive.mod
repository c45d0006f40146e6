;-----
; One drive places two axes, one after the other. Normally both devices are in the state st_regoff; the one
; that is to move gets REGON when its motor is on the drive, and REGOFF when it has arrived. A contactor is
; switched only with the drive blocked. After REGOFF the output keeps its last voltage: the next axis takes it
; over with REGON before the drive is enabled.
; gbStep: 1 the gauge moves, 2 has arrived, 3 the lift moves, 4 has arrived, 5 all done
;-----
;-----
; Set-up of the axes: screw lead 20 mm, 2500 lines a turn of the motor
;-----
Gauge:cntratio = 80000
Gauge:decpt    = 2
Gauge:unitvel  = 0                ; speeds in mm/min
Gauge:maxvel   = 40000            ; 2000 rpm at 10 V, 20 mm a turn
Gauge:minpos   = 0
Gauge:maxpos   = 100000
Gauge:maxfollerr = 2000
Gauge:rampmode = 0
Gauge:taccdec  = 100              ; 1 s from rest to maxvel
Gauge:rtype    = 1
Gauge:toll     = 5
Gauge:feedfw   = 1000
Gauge:pgain    = 150
Lift:cntratio  = 80000
Lift:decpt     = 2
Lift:unitvel   = 0
Lift:maxvel    = 40000
Lift:minpos    = 0
Lift:maxpos    = 100000
Lift:maxfollerr = 2000
Lift:rampmode  = 0
Lift:taccdec   = 100
Lift:rtype     = 1
Lift:toll      = 5
Lift:feedfw    = 1000
Lift:pgain     = 150

INIT Gauge
WAIT Gauge:st_init
REGOFF Gauge                      ; nobody regulates
WAIT Gauge:st_regoff
CNTUNLOCK Gauge
WAIT NOT Gauge:st_cntlock
CNTDIR Gauge
WAIT NOT Gauge:st_cntrev
LOOPON Gauge
WAIT Gauge:st_loopon
Gauge:posit = 10000               ; where the ruler says it stands
INIT Lift
WAIT Lift:st_init
REGOFF Lift
WAIT Lift:st_regoff
CNTUNLOCK Lift
WAIT NOT Lift:st_cntlock
CNTDIR Lift
WAIT NOT Lift:st_cntrev
LOOPON Lift
WAIT Lift:st_loopon
Lift:posit = 10000

FOR (glTour = 1, glTour LE slTours, 1)
    CALL PlaceGauge
    CALL PlaceLift
NEXT
gbStep = 5
END

SUB PlaceGauge
    RESOUT ofLift
    tmSwitch = 60                 ; one contactor opens, then the other closes
    WAIT tmSwitch
    REGON Gauge
    WAIT NOT Gauge:st_regoff
    SETOUT ofEnable
    tmSwitch = 20
    WAIT tmSwitch
    gbStep = 1
    Gauge:setvel = 20000
    Gauge:setpos = asDepth[glTour]
    START Gauge
    WAIT NOT Gauge:st_still
    WAIT Gauge:st_still
    tmSwitch = 200                ; until it rests
    WAIT tmSwitch
    RESOUT ofEnable
    REGOFF Gauge
    WAIT Gauge:st_regoff
    gbStep = 2
ENDSUB

SUB PlaceLift
    SETOUT ofLift
    tmSwitch = 60
    WAIT tmSwitch
    REGON Lift
    WAIT NOT Lift:st_regoff
    SETOUT ofEnable
    SETOUT ofBrake
    tmSwitch = 100                ; the brake lets go
    WAIT tmSwitch
    gbStep = 3
    Lift:setvel = 12000
    Lift:setpos = asHeight[glTour]
    START Lift
    WAIT NOT Lift:st_still
    WAIT Lift:st_still
    tmSwitch = 200
    WAIT tmSwitch
    RESOUT ofBrake
    tmSwitch = 80                 ; it holds before the drive lets go
    WAIT tmSwitch
    RESOUT ofEnable
    REGOFF Lift
    WAIT Lift:st_regoff
    gbStep = 4
ENDSUB

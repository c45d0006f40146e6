;-----
; The same quotas from below and from above, without and with recovery of the backlash.
; See onoff_backlash.cnf.
;-----
;-----
; Set-up of the axis: screw lead 20 mm, 2500 lines a turn of the motor
;-----
Axis:cntratio = 80000
Axis:decpt    = 2
Axis:unitvel  = 1                 ; speeds in mm/s
Axis:minpos   = 0
Axis:maxpos   = 100000
Axis:slowpos  = 4000
Axis:slowdly  = 0                 ; an inverter changes its speed while it runs
Axis:tbrake   = 0
Axis:tinvt    = 30
Axis:toldly   = 50
Axis:tollp    = 200               ; 0.2 mm
Axis:tolln    = 200
Axis:overpos  = 800               ; 8 mm
Axis:bklashmode = 0
Axis:ninert   = 1
Axis:dobiner  = 1
Axis:inertmode = 1
Axis:slowtype = 0
Axis:tool     = 0
Axis:enstol   = 1

INIT Axis
WAIT Axis:st_init
CNTUNLOCK Axis
WAIT NOT Axis:st_cntlock
CNTDIR Axis
WAIT NOT Axis:st_cntrev
REGON Axis
WAIT NOT Axis:st_regoff
Axis:posit = 10000                ; where the load stands

gaQuota[1] = 30000
gaQuota[2] = 45000
gaQuota[3] = 30000
gaQuota[4] = 15000

FOR (gbTour = 1, gbTour LE 4, 1)
    IF gbTour EQ 4
        Axis:bklashmode = 1
    ENDIF
    FOR (gbPlace = 1, gbPlace LE cPlaces, 1)
        Axis:setpos = gaQuota[gbPlace]
        START Axis
        WAIT NOT Axis:st_still
        WAIT Axis:st_still
        gfJudge = 1
        tmRest = 100
        WAIT tmRest
        gfJudge = 0
    NEXT
NEXT
gbPlace = 0
END

;-----
; Placements up and down, tour after tour: the device learns how far the ram coasts.
; dobiner, ninert and inertmode are the scenario's. See press.cnf.
;-----
;-----
; Set-up of the axis: lead 10 mm, 2500 lines a turn of the motor
;-----
Axis:cntratio = 40000
Axis:decpt    = 2
Axis:unitvel  = 1                 ; speeds in mm/s
Axis:minpos   = 0
Axis:maxpos   = 60000
Axis:slowpos  = 7000              ; with a heavier tool it is slow only after 60 mm
Axis:slowdly  = 3                 ; the contactors change over, the brake does not notice
Axis:tbrake   = 5
Axis:tinvt    = 30
Axis:toldly   = 50
Axis:tollp    = 300               ; 0.3 mm
Axis:tolln    = 300
Axis:breaktype = 1                ; the output releases the brake
Axis:slowtype = 0
Axis:bklashmode = 0
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
Axis:posit = 30000                ; where the ruler says it stands
gfReady = 1

; Each third of the stroke is reached once from below and once from above.
gaQuota[1] = 55000
gaQuota[2] = 45000
gaQuota[3] = 30000
gaQuota[4] = 6000
gaQuota[5] = 16000
gaQuota[6] = 35000

WHILE (gbTour LT slTours)
    IF gbTour
        tmRest = slPause
        WAIT tmRest
    ENDIF
    gbTour = gbTour + 1
    FOR (gbPlace = 1, gbPlace LE cPlaces, 1)
        WAIT ifStart              ; switched off, the ram rests after the placement that runs
        Axis:setpos = gaQuota[gbPlace]
        START Axis
        WAIT NOT Axis:st_still
        WAIT Axis:st_still
        glMiss = Axis:posit - Axis:setpos
        gfJudge = 1
        tmRest = 100
        WAIT tmRest
        gfJudge = 0
        WAIT NOT gbAlarm
    NEXT
ENDWHILE
gbPlace = 0
END

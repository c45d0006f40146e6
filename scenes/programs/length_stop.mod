;-----
; Length stop, see length_stop.cnf. Set slLength, slStep and slTact before the start.
;-----
; Set-up of the axis: screw lead 20 mm, 2500 lines a turn of the motor
;-----
Axis:cntratio = 80000
Axis:decpt    = 2
Axis:unitvel  = 0                 ; speeds in mm/min
Axis:maxvel   = 40000             ; 2000 rpm at 10 V, 20 mm a turn
Axis:prsvel   = 6000
Axis:sprsvel  = 1200
Axis:minpos   = 0
Axis:maxpos   = 100000
Axis:maxfollerr = 1000            ; 2 mm
Axis:rampmode = 0
Axis:taccdec  = 50                ; 0.5 s from rest to maxvel
Axis:rtype    = 1
Axis:toll     = 3
Axis:prsmode  = 1                 ; home switch, then the zero pulse of the motor
Axis:prsdir   = 1                 ; the switch is behind the axis
Axis:prspos   = 2000              ; the zero pulse behind the switch is at 20 mm
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
EMRG Axis                         ; 0 V until somebody switches on
WAIT Axis:st_emrg

MAIN:
;-----
; Emergency stop, or a fault: whatever runs ends. EMRG gives 0 V at once, at which the drive brakes as hard as
; it can; then its enable falls.
;-----
IF gbPhase NE cOff AND NOT (ifChain AND ifReady AND NOT Axis:st_foller)
    EMRG Axis
    WAIT Axis:st_emrg
    ofThere = 0
    ofFault = 1
    tmPower = 200
    gbPhase = cOff
ENDIF

;-----
; On again: only a reset that is pressed now, behind a closed chain. Nothing moves yet. The axis has counted on
; while it was off: it needs no second search.
;-----
IF gbPhase EQ cOff AND tmPower
    ofEnable = 0
    IF ifChain AND ifReady AND ifReset AND NOT gfReset
        ofEnable = 1
        tmPower = 100
        gbPhase = cOn
    ENDIF
ENDIF
IF gbPhase EQ cOn AND tmPower
    RESUME Axis
    LOOPON Axis
    WAIT NOT Axis:st_emrg
    ofFault = 0
    gbPhase = cReady
    IF NOT Axis:st_prsok
        gbPhase = cHome
        PRESET Axis
        WAIT Axis:st_prson
    ENDIF
ENDIF
IF gbPhase EQ cHome AND Axis:st_prsok AND Axis:st_still
    gbPhase = cReady
ENDIF

;-----
; A tour, length after length, as long as start is on. What was on before the drive was starts nothing.
;-----
IF gbPhase EQ cReady AND ifStart AND NOT gfStart
    gbPlace = 1
    CALL Place
ENDIF
IF gbPhase EQ cMoves AND Axis:st_toll AND Axis:st_still
    ofThere = 1
    glDone = glDone + 1
    gbPhase = cThere
ENDIF
IF gbPhase EQ cThere AND tmTact
    ofThere = 0
    gbPhase = cReady
    IF ifStart
        gbPlace = gbPlace + 1
        IF gbPlace GT cPlaces
            gbPlace = 1
        ENDIF
        CALL Place
    ENDIF
ENDIF
gfReset = ifReset
gfStart = ifStart
WAIT 1
JUMP MAIN

SUB Place
    tmTact = slTact
    Axis:setvel = 20000           ; the search has left its own there
    Axis:setpos = slLength + (gbPlace - 1) * slStep
    START Axis
    WAIT NOT Axis:st_still
    gbPhase = cMoves
ENDSUB
END

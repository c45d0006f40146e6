;-----
; Axis and orders of the length stop. An order is a recipe: up to three lengths, each with a number of pieces.
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
Axis:maxpos   = 100 * 1000        ; 1 m
Axis:maxfollerr = 1000            ; 10 mm
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

;-----
; Recipes that the machine comes with; what the panel has set stays
;-----
IF ddlLength[1, 1] EQ 0
    ddlFeed[1]      = 20000
    ddlLength[1, 1] = 300 * 100
    ddwPieces[1, 1] = 2
    ddlLength[1, 2] = 450 * 100
    ddwPieces[1, 2] = 1
    ddlFeed[2]      = 12000
    ddlLength[2, 1] = 20000
    ddwPieces[2, 1] = 2
ENDIF
IF slTact EQ 0
    slTact = 500
ENDIF

;-----
; The axis wakes up, its drive off
;-----
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
; it can; then its enable falls. The order keeps what is left of it.
;-----
IF gbPhase NE cOff
    IF NOT ifChain
        gbCause = cChain
        CALL Stop
    ELSE
        IF NOT ifReady
            gbCause = cDrive
            CALL Stop
        ELSE
            IF Axis:st_foller
                gbCause = cFoller
                CALL Stop
            ENDIF
        ENDIF
    ENDIF
ENDIF

;-----
; On again: only a reset that is pressed now, behind a closed chain
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
; An order, piece after piece
;-----
IF gbPhase EQ cReady AND ifStart AND gbAlarm EQ cNoAlarm
    IF gbRecipe EQ 0 AND gbWaiting GT 0
        CALL Take
    ENDIF
    IF gbRecipe GT 0
        IF gwLeft GT 0
            CALL Place
        ELSE
            CALL Further
        ENDIF
    ENDIF
ENDIF
IF gbPhase EQ cMoves
    IF Axis:st_toll AND Axis:st_still
        ofThere = 1
        tmTact = slTact
        gbPhase = cThere
    ELSE
        IF tmSlow
            gbCause = cSlow
            CALL Stop
        ENDIF
    ENDIF
ENDIF
IF gbPhase EQ cThere AND tmTact
    ofThere = 0
    gwLeft = gwLeft - 1
    glPieces = glPieces + 1
    slTotal = slTotal + 1
    glWaste = glWaste + ddlLength[gbRecipe, gbStep] + 300
    gbPhase = cReady
ENDIF
gfRuns = gbRecipe
gfReset = ifReset
WAIT 1
JUMP MAIN

;-----
; The first order of the queue becomes the present one; the others move up
;-----
SUB Take
    gbRecipe = agbQueue[1]
    FOR (glI = 1, glI LT cQueue, 1)
        agbQueue[glI] = agbQueue[glI + 1]
    NEXT
    agbQueue[cQueue] = 0
    gbWaiting = gbWaiting - 1
    gbStep = 1
    gwLeft = ddwPieces[gbRecipe, 1]
    IF ddlLength[gbRecipe, 1] EQ 0
        gbCause = cEmpty
        gbRecipe = 0
    ENDIF
ENDSUB

;-----
; The next length of the recipe, or the end of the order
;-----
SUB Further
    gbStep = gbStep + 1
    IF gbStep LE cSteps
        IF ddlLength[gbRecipe, gbStep] GT 0
            gwLeft = ddwPieces[gbRecipe, gbStep]
            JUMP Further_end
        ENDIF
    ENDIF
    gbRecipe = 0
    gbStep = 0
    glOrders = glOrders + 1
    Further_end:
ENDSUB

;-----
; To the length of the piece
;-----
SUB Place
    tmSlow = 5000
    Axis:setvel = ddlFeed[gbRecipe]   ; the search has left its own there
    Axis:setpos = ddlLength[gbRecipe, gbStep]
    START Axis
    IF Axis:posit NE ddlLength[gbRecipe, gbStep]
        WAIT NOT Axis:st_still OR Axis:st_toll
    ENDIF
    glPlace = glPlace + 1
    gbPhase = cMoves
ENDSUB

;-----
; All off
;-----
SUB Stop
    EMRG Axis
    WAIT Axis:st_emrg
    ofThere = 0
    tmPower = 200
    gbPhase = cOff
ENDSUB
END

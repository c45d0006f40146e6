;-----
; Shifts and blade of the length stop: figures of this shift and the two before it, how often each alarm came,
; what the blade has sawn. All of it outlasts the power.
;-----
tmShift = 1000
IF slLife EQ 0
    slLife = cLife
ENDIF

SHIFT:
CALL Count
CALL Blade
IF ifShift AND NOT gfShift
    CALL NextShift
ENDIF
gfShift = ifShift
IF tmShift
    tmShift = 1000
    CALL Second
ENDIF
WAIT 1
JUMP SHIFT

;-----
; What has come since the turn before goes to the present shift, the pieces to the blade, too
;-----
SUB Count
    aslPieces[1] = aslPieces[1] + glPieces - glSeen
    slBlade = slBlade + glPieces - glSeen
    glSeen = glPieces
    aslOrders[1] = aslOrders[1] + glOrders - glDone
    glDone = glOrders
    IF gbAlarm NE cNoAlarm AND gbStood EQ cNoAlarm
        aslStops[1] = aslStops[1] + 1
        aswAlarms[gbAlarm] = aswAlarms[gbAlarm] + 1
    ENDIF
    gbStood = gbAlarm
ENDSUB

;-----
; A second of the shift: what it was spent with, and the share of work
;-----
SUB Second
    IF gbAlarm NE cNoAlarm
        aslDown[1] = aslDown[1] + 1
    ELSE
        IF gfRuns
            aslBusy[1] = aslBusy[1] + 1
        ELSE
            aslIdle[1] = aslIdle[1] + 1
        ENDIF
    ENDIF
    gbWorked = 100 * aslBusy[1] / (aslBusy[1] + aslDown[1] + aslIdle[1])
ENDSUB

;-----
; The shifts move on by one; the last is forgotten
;-----
SUB NextShift
    FOR (glK = cShifts, glK GT 1, -1)
        aslPieces[glK] = aslPieces[glK - 1]
        aslOrders[glK] = aslOrders[glK - 1]
        aslStops[glK] = aslStops[glK - 1]
        aslBusy[glK] = aslBusy[glK - 1]
        aslDown[glK] = aslDown[glK - 1]
        aslIdle[glK] = aslIdle[glK - 1]
    NEXT
    aslPieces[1] = 0
    aslOrders[1] = 0
    aslStops[1] = 0
    aslBusy[1] = 0
    aslDown[1] = 0
    aslIdle[1] = 0
    gbWorked = 0
ENDSUB

;-----
; The blade: a lamp when its life is over, an alarm at half as much again. A button that is held makes it new.
;-----
SUB Blade
    ofBlade = slBlade GE slLife
    IF slBlade GE slLife + slLife / 2 AND NOT gfBlunt AND gbCause EQ cNoAlarm
        gbCause = cBlunt
        gfBlunt = 1
    ENDIF
    IF NOT ifBlade
        tmBlade = 2000
        gfChanged = 0
    ENDIF
    IF ifBlade AND tmBlade AND NOT gfChanged
        slBlade = 0
        slBlades = slBlades + 1
        gfBlunt = 0
        gfChanged = 1
    ENDIF
ENDSUB
END

;-----
; Tests: drycut test stop_orders.cnf stop_shift.mod
;-----
SUB TEST_Count
    glPieces = 3
    glOrders = 1
    CALL Count
    glPieces = 5
    CALL Count
    ; ASSERT aslPieces[1] EQ 5 AND aslOrders[1] EQ 1 AND slBlade EQ 5
    gbAlarm = cDrive
    CALL Count
    CALL Count                    ; it stands on: one stop
    ; ASSERT aslStops[1] EQ 1 AND aswAlarms[cDrive] EQ 1 AND aswAlarms[cChain] EQ 0
ENDSUB

SUB TEST_Second
    gfRuns = 1
    CALL Second
    CALL Second
    CALL Second
    gbAlarm = cChain              ; an order that stands is no work
    CALL Second
    ; ASSERT aslBusy[1] EQ 3 AND aslDown[1] EQ 1 AND aslIdle[1] EQ 0
    ; ASSERT gbWorked EQ 75
ENDSUB

SUB TEST_NextShift
    aslPieces[1] = 30
    aslPieces[2] = 20
    aslPieces[3] = 10
    aslDown[1] = 7
    CALL NextShift
    ; ASSERT aslPieces[1] EQ 0 AND aslPieces[2] EQ 30 AND aslPieces[3] EQ 20
    ; ASSERT aslDown[1] EQ 0 AND aslDown[2] EQ 7
ENDSUB

SUB TEST_Blade
    slLife = 10
    slBlade = 9
    CALL Blade
    ; ASSERT NOT ofBlade
    slBlade = 14
    CALL Blade
    ; ASSERT ofBlade AND gbCause EQ cNoAlarm
    slBlade = 15
    CALL Blade
    ; ASSERT gbCause EQ cBlunt
    gbCause = cNoAlarm
    CALL Blade                    ; once a blade
    ; ASSERT gbCause EQ cNoAlarm
ENDSUB

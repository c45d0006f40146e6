;-----
; What a careful programmer watches besides the placements: the ram must not move at rest, the count must move
; when an output is on, the limit switches stop everything. An alarm is kept; no placement follows it.
;-----
WAIT gfReady                      ; the set-up is the other task's, whichever runs first
LOOK:
glLook = Axis:posit
gfStill = Axis:st_still
gfOn = Axis:st_movfwd OR Axis:st_movbwd
tmLook = 250
WAIT tmLook
IF gbAlarm EQ 0
    IF gfStill AND Axis:st_still
        IF (Axis:posit - glLook GT cSagging) OR (glLook - Axis:posit GT cSagging)
            gbAlarm = 1
        ENDIF
    ENDIF
    IF gfOn AND (Axis:st_movfwd OR Axis:st_movbwd)
        IF Axis:posit EQ glLook
            gbAlarm = 2
        ENDIF
    ENDIF
    IF ifLow OR ifHigh
        gbAlarm = 3
    ENDIF
    IF gbAlarm
        STOP Axis
        ofAlarm = 1
    ENDIF
ENDIF
JUMP LOOK
END

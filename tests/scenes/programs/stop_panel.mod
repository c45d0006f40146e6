;-----
; Panel of the length stop: orders, alarms with a history, lamps, figures.
;-----
tmSecond = 1000
tmBlink = 250

PANEL:
;-----
; An order: the recipe switch, then the button
;-----
gbNumber = ifSwitch1 + 2 * ifSwitch2
IF ifOrder AND NOT gfOrder
    IF gbNumber GE 1 AND gbNumber LE cRecipes AND gbWaiting LT cQueue
        gbWaiting = gbWaiting + 1
        agbQueue[gbWaiting] = gbNumber
    ELSE
        gbCause = cRefused
    ENDIF
ENDIF
gfOrder = ifOrder

;-----
; Alarms: the first one stays until the reset. All of them go into the history.
;-----
IF gbCause NE cNoAlarm
    FOR (glJ = cHistory, glJ GT 1, -1)
        agbAlarms[glJ] = agbAlarms[glJ - 1]
        aglAlarmed[glJ] = aglAlarmed[glJ - 1]
    NEXT
    agbAlarms[1] = gbCause
    aglAlarmed[1] = glSeconds
    IF gbAlarm EQ cNoAlarm
        gbAlarm = gbCause
    ENDIF
    gbCause = cNoAlarm
ENDIF
IF gbAlarm NE cNoAlarm AND ifReset AND ifChain AND ifReady
    gbAlarm = cNoAlarm
ENDIF

;-----
; Figures, once a second
;-----
IF tmSecond
    tmSecond = 1000
    glSeconds = glSeconds + 1
    IF gfRuns
        glBusy = glBusy + 1
    ENDIF
    gbShare = 100 * glBusy / glSeconds
ENDIF

;-----
; Lamps
;-----
IF tmBlink
    tmBlink = 250
    gfBlink = NOT gfBlink
ENDIF
ofFault = gbAlarm NE cNoAlarm AND gfBlink
ofWaiting = gbWaiting
WAIT 1
JUMP PANEL
END

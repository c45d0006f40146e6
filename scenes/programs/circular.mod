;-----
; Circular interpolation, see circular.cnf: the four arcs of radius 26 mm from A (0, 0) to B (15, -33), one
; after the other.
;-----
; Simulated master: one Um is a thousandth of a millimetre, 4 bits.
;-----
Master:decpt    = 3
Master:unitvel  = 0               ; speeds in mm/min
Master:cntratio = 100000
Master:maxvel   = 3000
Master:setvel   = 1800
Master:rampmode = 1                ; tacc and tdec apart
Master:tacc     = 80
Master:tdec     = 80
Master:ramptype = 1
Master:minpos   = - 999999
Master:maxpos   = 999999
Master:feedfw   = 1000
INIT Master
WAIT Master:st_init
LOOPOFF Master
CNTUNLOCK Master
CNTDIR Master
REGON Master
WAIT NOT Master:st_regoff

;-----
; X and Y: screw lead 5 mm, 10000 bits a turn; 10 V = 2000 rpm = 10 m/min
;-----
AxisX:decpt    = 3
AxisX:measure  = 5000
AxisX:pulse    = 10000
AxisX:measurem = 1000
AxisX:pulsem   = 4000
AxisX:unitvel  = 0
AxisX:maxvel   = 10000
AxisX:setvel   = 2400
AxisX:prsvel   = 1500
AxisX:sprsvel  = 240
AxisX:tacc     = 60
AxisX:tdec     = 60
AxisX:taccmax  = 10
AxisX:tdecmax  = 10
AxisX:minpos   = - 55000
AxisX:maxpos   = 70000
AxisX:toll     = 5
AxisX:syncrange = 100
AxisX:maxfollerr = 1000
AxisX:ramptype = 1
AxisX:rtype    = 1
AxisX:prsmode  = 1
AxisX:prsdir   = 1
AxisX:prspos   = - 45000          ; the zero pulse behind the home switch
AxisX:pgain    = 200
AxisX:feedfw   = 1000
INIT AxisX
WAIT AxisX:st_init
LOOPON AxisX
CNTUNLOCK AxisX
CNTDIR AxisX
CNTUNLOCKM AxisX
CNTDIRM AxisX
REGON AxisX
WAIT NOT AxisX:st_regoff

AxisY:decpt    = 3
AxisY:measure  = 5000
AxisY:pulse    = 10000
AxisY:measurem = 1000
AxisY:pulsem   = 4000
AxisY:unitvel  = 0
AxisY:maxvel   = 10000
AxisY:setvel   = 2400
AxisY:prsvel   = 1500
AxisY:sprsvel  = 240
AxisY:tacc     = 60
AxisY:tdec     = 60
AxisY:taccmax  = 10
AxisY:tdecmax  = 10
AxisY:minpos   = - 70000
AxisY:maxpos   = 35000
AxisY:toll     = 5
AxisY:syncrange = 100
AxisY:maxfollerr = 1000
AxisY:ramptype = 1
AxisY:rtype    = 1
AxisY:prsmode  = 1
AxisY:prsdir   = 1
AxisY:prspos   = - 60000
AxisY:pgain    = 200
AxisY:feedfw   = 1000
INIT AxisY
WAIT AxisY:st_init
LOOPON AxisY
CNTUNLOCK AxisY
CNTDIR AxisY
CNTUNLOCKM AxisY
CNTDIRM AxisY
REGON AxisY
WAIT NOT AxisY:st_regoff

;-----
; Tangent: 400000 bits a turn, 10 V = 360 degrees a second; its zero is where it stands
;-----
AxisC:decpt    = 3
AxisC:measure  = 360000
AxisC:pulse    = 400000
AxisC:measurem = 1000
AxisC:pulsem   = 4000
AxisC:unitvel  = 0                ; speeds in degrees a minute
AxisC:maxvel   = 21600
AxisC:setvel   = 10800
AxisC:tacc     = 60
AxisC:tdec     = 60
AxisC:taccmax  = 10
AxisC:tdecmax  = 10
AxisC:minpos   = - 999999
AxisC:maxpos   = 999999
AxisC:toll     = 50
AxisC:syncrange = 500
AxisC:maxfollerr = 100000
AxisC:ramptype = 1
AxisC:rtype    = 1
AxisC:pgain    = 200
AxisC:feedfw   = 1000
INIT AxisC
WAIT AxisC:st_init
LOOPON AxisC
CNTUNLOCK AxisC
CNTDIR AxisC
CNTUNLOCKM AxisC
CNTDIRM AxisC
REGON AxisC
WAIT NOT AxisC:st_regoff
AxisC:posit = 0

;-----
; Home X and Y
;-----
gbPhase = 1
PRESET AxisX
PRESET AxisY
WAIT AxisX:st_prsok AND AxisY:st_prsok
gbNext = 1
AxisX:setvel = 2400
AxisY:setvel = 2400

MAIN:
CALL Choose
CALL ToA
IF gbNext GT 4
    gbPhase = 7
    JUMP DONE
ENDIF
gbPhase = 2
WAIT ifStart
CALL Program
Master:posit  = 0
Master:setpos = glLength
STARTCAM AxisX
STARTCAM AxisY
STARTCAM AxisC
WAIT AxisX:st_camex AND AxisY:st_camex AND AxisC:st_camex
gbPhase = 3
gbArc = gbNext
ofPen = 1
START Master
WAIT NOT AxisX:st_camex AND NOT AxisY:st_camex AND NOT AxisC:st_camex
gbPhase = 4
tmRest = 200
WAIT tmRest
gbPhase = 5
tmRest = 200
WAIT tmRest
ofPen = 0
gbArc = 0
gbNext = gbNext + 1
gbPhase = 6
WAIT Master:st_still
JUMP MAIN

DONE:
WAIT 1
JUMP DONE

;-----
; The trajectories of the manual's example: I and II counterclockwise, III and IV clockwise; II and III short
;-----
SUB Choose
    IF gbNext LE 2
        gwTurn = 1
    ELSE
        gwTurn = 0
    ENDIF
    IF gbNext EQ 2 OR gbNext EQ 3
        glRadius = cRadius
        glLength = cShort
    ELSE
        glRadius = - cRadius
        glLength = cLong
    ENDIF
    IF gbNext EQ 1
        glHeading = 158639
    ENDIF
    IF gbNext EQ 2
        glHeading = - 109751
    ENDIF
    IF gbNext EQ 3
        glHeading = - 21361
    ENDIF
    IF gbNext EQ 4
        glHeading = 70249
    ENDIF
ENDSUB

; Pen up, back to A, the tangent into the direction of the coming arc
SUB ToA
    AxisX:setpos = 0
    AxisY:setpos = 0
    AxisC:setpos = glHeading
    START AxisX
    START AxisY
    START AxisC
    WAIT AxisX:st_toll AND AxisX:st_still
    WAIT AxisY:st_toll AND AxisY:st_still
    WAIT AxisC:st_toll AND AxisC:st_still
ENDSUB

SUB Program
    AxisX:codeG1  = 170 + gwTurn
    AxisX:codeQm1 = glRadius
    AxisX:codeQs1 = cDeltaX
    AxisX:codeQsa1 = cDeltaY
    AxisX:codeG2  = 136
    AxisY:codeG1  = 172 + gwTurn
    AxisY:codeQm1 = glRadius
    AxisY:codeQs1 = cDeltaX
    AxisY:codeQsa1 = cDeltaY
    AxisY:codeG2  = 136
    AxisC:codeG1  = 174 + gwTurn
    AxisC:codeQm1 = glRadius
    AxisC:codeQs1 = cDeltaX
    AxisC:codeQsa1 = cDeltaY
    AxisC:codeG2  = 136
ENDSUB
END

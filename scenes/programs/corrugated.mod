;-----
; Cut-off of a corrugator, see corrugated.cnf. Set slLength before the start; a new value while the knife runs is a
; new order: the sheet under way and at most one more are cut as they were, then come those of the new length. The cam
; has two blocks of rows, a sheet each. One runs; the other one is filled with the new order, then the jump at the end
; of the running one is turned to it.
;-----
; Set-up of the axis: 8192 bits a turn of the motor, gear 5:1, 600 mm of board a turn of the drums;
; measuring wheel 10000 bits for 500 mm; 10 V = 3000 rpm of the motor = 360 m/min of the blades.
;-----
AxisX:decpt    = 1
AxisX:measure  = 6000
AxisX:pulse    = 40960
AxisX:measurem = 5000
AxisX:pulsem   = 10000
AxisX:unitvel  = 0                ; speeds in mm/min
AxisX:maxvel   = 360000
AxisX:setvel   = 30000
AxisX:prsvel   = 20000
AxisX:sprsvel  = 2000
AxisX:tacc     = 100              ; 1 s from 0 to maxvel
AxisX:tdec     = 20               ; 0.2 s from maxvel to 0: STOPCAM must end before the next cut
AxisX:taccmax  = 4
AxisX:tdecmax  = 4
AxisX:minpos   = - 999999
AxisX:maxpos   = 999999
AxisX:toll     = 5
AxisX:syncrange = 30
AxisX:maxfollerr = 2000
AxisX:ramptype = 1                ; epicycloidal placements
AxisX:rtype    = 1
AxisX:prsmode  = 1                ; home switch, then the encoder's zero pulse
AxisX:prsdir   = 0
AxisX:prspos   = - 600            ; the zero pulse lies 60 mm before the blade's top
AxisX:funOut   = 5                ; output: in synchronism
IF AxisX:pgain EQ 0               ; gains, unless the commissioning has set them
    AxisX:pgain  = 60
    AxisX:feedfw = 1000
ENDIF

INIT AxisX
WAIT AxisX:st_init
LOOPON AxisX
WAIT AxisX:st_loopon
CNTUNLOCK AxisX
CNTDIR AxisX
CNTUNLOCKM AxisX
CNTDIRM AxisX
REGON AxisX
WAIT NOT AxisX:st_regoff

;-----
; Home: search the preset, then bring the blade on top (position 0)
;-----
gbPhase = 1
PRESET AxisX
WAIT AxisX:st_prsok
AxisX:setvel = 30000
AxisX:setpos = 0
START AxisX
WAIT AxisX:st_toll AND AxisX:st_still
gbPhase = 2

MAIN:
IF gbPhase EQ 2 AND ifStart
    CALL Begin
    STARTCAM AxisX
    WAIT AxisX:st_camex
    ofCutting = 1
    gbPhase = 3
ENDIF
; A new order: taken while the blade is in the cut zone of the block that runs, when none of the rows that change
; is the running or the next one
IF gbPhase EQ 3 AND slLength NEQ glCut
    IF gbFirst AND AxisX:rowex EQ 3
        CALL Second
        AxisX:codeQm8 = 9
        gbFirst = 0
    ENDIF
    IF NOT gbFirst AND AxisX:rowex EQ 9
        CALL First
        AxisX:codeQm14 = 3
        gbFirst = 1
    ENDIF
ENDIF
; Stop: only while the blade is on its way over the top, so that it never brakes inside the board
IF gbPhase EQ 3 AND NOT ifStart AND (AxisX:rowex EQ 4 OR AxisX:rowex EQ 10) AND AxisX:posit LT cCircum
    STOPCAM AxisX
    WAIT AxisX:st_still AND NOT AxisX:st_camex
    ofCutting = 0
    gbPhase = 4
ENDIF
IF gbPhase EQ 3 AND NOT AxisX:st_camex
    ofCutting = 0                 ; the device left the cam by itself (error)
    gbPhase = 0
ENDIF
IF gbPhase EQ 4                   ; back on top
    AxisX:setvel = 30000
    AxisX:setpos = cCircum
    START AxisX
    WAIT AxisX:st_toll AND AxisX:st_still
    AxisX:posit = AxisX:posit - cCircum
    gbPhase = 2
ENDIF
WAIT 1
JUMP MAIN

;-----
; The cam. Blades apart at the start; they meet half a turn later.
;-----
SUB Begin
    ; 1: up to the speed of the board
    AxisX:codeG1  = 232
    AxisX:codeQm1 = 5000
    AxisX:codeQs1 = 2500
    AxisX:codeM1  = 0
    ; 2: at its speed until the cut zone
    AxisX:codeG2  = 133
    AxisX:codeQm2 = cCircum / 2 - 2500 - cCutZone / 2
    AxisX:codeQs2 = cCircum / 2 - 2500 - cCutZone / 2
    AxisX:codeM2  = 0
    CALL First
    gbFirst = 1
ENDSUB

; A sheet: cut zone; the rest of the turn in the rest of the sheet, slower or faster than the board, or with a stop on
; top; then one sheet is taken off the master and one turn off the slave, and the same block comes again.
SUB First
    glCut = slLength
    glOrders = glOrders + 1
    AxisX:codeG3  = 133
    AxisX:codeQm3 = cCutZone
    AxisX:codeQs3 = cCutZone
    AxisX:codeM3  = 1000
    IF glCut GT cStopLen
        AxisX:codeG4  = 235
        AxisX:codeQm4 = cCircum - cCutZone
        AxisX:codeQs4 = (cCircum - cCutZone) / 2
        AxisX:codeG5  = 133
        AxisX:codeQm5 = glCut - cStopLen
        AxisX:codeQs5 = 0
        AxisX:codeG6  = 232
        AxisX:codeQm6 = cCircum - cCutZone
        AxisX:codeQs6 = (cCircum - cCutZone) / 2
    ELSE
        AxisX:codeG4  = 234
        AxisX:codeQm4 = glCut - cCutZone
        AxisX:codeQs4 = cCircum - cCutZone
        AxisX:codeG5  = 130
        AxisX:codeG6  = 130
    ENDIF
    AxisX:codeG7  = 139
    AxisX:codeQm7 = glCut
    AxisX:codeQs7 = cCircum
    AxisX:codeG8  = 137
    AxisX:codeQm8 = 3
ENDSUB

; The same in rows 9 to 14
SUB Second
    glCut = slLength
    glOrders = glOrders + 1
    AxisX:codeG9  = 133
    AxisX:codeQm9 = cCutZone
    AxisX:codeQs9 = cCutZone
    AxisX:codeM9  = 1000
    IF glCut GT cStopLen
        AxisX:codeG10  = 235
        AxisX:codeQm10 = cCircum - cCutZone
        AxisX:codeQs10 = (cCircum - cCutZone) / 2
        AxisX:codeG11  = 133
        AxisX:codeQm11 = glCut - cStopLen
        AxisX:codeQs11 = 0
        AxisX:codeG12  = 232
        AxisX:codeQm12 = cCircum - cCutZone
        AxisX:codeQs12 = (cCircum - cCutZone) / 2
    ELSE
        AxisX:codeG10  = 234
        AxisX:codeQm10 = glCut - cCutZone
        AxisX:codeQs10 = cCircum - cCutZone
        AxisX:codeG11  = 130
        AxisX:codeG12  = 130
    ENDIF
    AxisX:codeG13  = 139
    AxisX:codeQm13 = glCut
    AxisX:codeQs13 = cCircum
    AxisX:codeG14  = 137
    AxisX:codeQm14 = 9
ENDSUB
END

;-----
; Flying saw, see flying_saw.cnf. Set slLength, slCut and slTravel before the start.
;-----
; Set-up of the axis: rack, 200 mm a turn of the pinion, gear 4:1, 10000 bits a turn of the motor;
; measuring wheel 40000 bits for 500 mm; 10 V = 3000 rpm of the motor = 150 m/min.
;-----
AxisX:decpt    = 1
AxisX:measure  = 500
AxisX:pulse    = 10000
AxisX:measurem = 5000
AxisX:pulsem   = 40000
AxisX:unitvel  = 0                ; speeds in mm/min
AxisX:maxvel   = 150000
AxisX:setvel   = 20000
AxisX:prsvel   = 6000
AxisX:sprsvel  = 1200
AxisX:tacc     = 80
AxisX:tdec     = 80
AxisX:taccmax  = 10
AxisX:tdecmax  = 10
AxisX:minpos   = - 200
AxisX:maxpos   = 20000
AxisX:toll     = 5
AxisX:syncrange = 10
AxisX:maxfollerr = 2000
AxisX:ramptype = 1
AxisX:rtype    = 1
AxisX:prsmode  = 1                ; home switch, then the zero pulse of the motor
AxisX:prsdir   = 1
AxisX:prspos   = 500              ; the zero pulse behind the switch is at 50 mm
AxisX:funOut   = 7                ; output: codeM 1000 and in synchronism
IF AxisX:pgain EQ 0               ; gains, unless the commissioning has set them
    AxisX:pgain  = 100
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
; Home: search the preset, then to position 0
;-----
gbPhase = 1
PRESET AxisX
WAIT AxisX:st_prsok
AxisX:setvel = 20000
AxisX:setpos = 0
START AxisX
WAIT AxisX:st_toll AND AxisX:st_still
gbPhase = 2

MAIN:
IF gbPhase EQ 2 AND ifStart
    glZone = slZone
    IF slZone EQ 0
        CALL Program
    ENDIF
    ofTooLong = slTravel GT 0 AND glOut GT slTravel
    IF NOT ofTooLong
        AxisX:positm = 0
        STARTCAM AxisX
        WAIT AxisX:st_camex
        ofCutting = 1
        gbPhase = 3
    ENDIF
ENDIF
IF gbPhase EQ 3 AND NOT AxisX:st_camex
    ofCutting = 0                 ; the device left the cam by itself (error)
    gbPhase = 0
ENDIF

;-----
; The cut, while the carriage runs with the tube
;-----
IF gbSaw EQ 0 AND gbPhase EQ 3 AND AxisX:rowex EQ glZone
    ofClamp = 1
    gbSaw = 1
ENDIF
IF gbSaw EQ 1 AND ifClamped
    ofPlunge = 1
    gbSaw = 2
ENDIF
IF gbSaw EQ 2 AND ifDown
    ofPlunge = 0
    gbSaw = 3
ENDIF
IF gbSaw EQ 3 AND ifUp
    ofClamp = 0
    gbSaw = 4
ENDIF
IF gbSaw EQ 4 AND NOT ifClamped
    IF AxisX:rowex NE glZone
        glLate = glLate + 1
    ENDIF
    gbSaw = 5
ENDIF
IF gbSaw EQ 5 AND AxisX:rowex GT glZone
    gbSaw = 0                     ; ready for the next piece
ENDIF
WAIT 1
JUMP MAIN

;-----
; The cam: nine sectors, then one piece is taken off the master
;-----
SUB Program
    ; 1: from rest to the tube's speed
    AxisX:codeG1  = 132
    AxisX:codeQm1 = cRunUp
    AxisX:codeQs1 = cRunUp / 2
    AxisX:codeM1  = 0
    ; 2: cut
    glZone        = 2
    AxisX:codeG2  = 133
    AxisX:codeQm2 = slCut
    AxisX:codeQs2 = slCut
    AxisX:codeM2  = 1000
    ; 3: to extra speed
    AxisX:codeG3  = 133
    AxisX:codeQm3 = cSpeedUp
    AxisX:codeQs3 = cSpeedUpS
    AxisX:codeM3  = 0
    ; 4: draw away
    AxisX:codeG4  = 133
    AxisX:codeQm4 = cAway
    AxisX:codeQs4 = cAwayS
    AxisX:codeM4  = 0
    ; 5: back to the tube's speed
    AxisX:codeG5  = 133
    AxisX:codeQm5 = cSpeedUp
    AxisX:codeQs5 = cSpeedUpS
    AxisX:codeM5  = 0
    ; 6: stop
    AxisX:codeG6  = 135
    AxisX:codeQm6 = cStop
    AxisX:codeQs6 = cStop / 2
    AxisX:codeM6  = 0
    ; 7 to 9: home in the rest of the piece, a third of it for each ramp
    glOut  = cRunUp / 2 + slCut + 2 * cSpeedUpS + cAwayS + cStop / 2
    glBack = slLength - cRunUp - slCut - 2 * cSpeedUp - cAway - cStop
    glRampM = glBack / 3
    glRampS = glOut / 4
    AxisX:codeG7  = 131
    AxisX:codeQm7 = glRampM
    AxisX:codeQs7 = - glRampS
    AxisX:codeM7  = 0
    AxisX:codeG8  = 133
    AxisX:codeQm8 = glBack - 2 * glRampM
    AxisX:codeQs8 = 2 * glRampS - glOut
    AxisX:codeM8  = 0
    AxisX:codeG9  = 135
    AxisX:codeQm9 = glRampM
    AxisX:codeQs9 = - glRampS
    AxisX:codeM9  = 0
    ; 10, 11: take one piece off the master, the carriage is at home; next piece
    AxisX:codeG10 = 139
    AxisX:codeQm10 = slLength
    AxisX:codeQs10 = 0
    AxisX:codeG11 = 137
    AxisX:codeQm11 = 1
ENDSUB
END

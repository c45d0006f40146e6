;-----
; Fly cut with extra speed, see fly_cut.cnf. Set slLength before the start.
;-----
; Set-up of the axis: belt, 200 mm a turn of the pulley, gear 5:1, 10000 bits a turn of the motor;
; measuring wheel 10000 bits for 500 mm; 10 V = 2000 rpm of the motor = 80 m/min.
;-----
AxisX:decpt    = 1
AxisX:measure  = 400
AxisX:pulse    = 10000
AxisX:measurem = 5000
AxisX:pulsem   = 10000
AxisX:unitvel  = 0                ; speeds in mm/min
AxisX:maxvel   = 80000
AxisX:setvel   = 20000
AxisX:prsvel   = 6000
AxisX:sprsvel  = 1200
AxisX:tacc     = 80
AxisX:tdec     = 80
AxisX:taccmax  = 20
AxisX:tdecmax  = 20
AxisX:minpos   = - 200
AxisX:maxpos   = 10000
AxisX:toll     = 5
AxisX:syncrange = 10
AxisX:maxfollerr = 1000
AxisX:ramptype = 1
AxisX:rtype    = 1
AxisX:prsmode  = 1                ; home switch, then the zero pulse of the motor
AxisX:prsdir   = 1
AxisX:prspos   = 400              ; the zero pulse behind the switch is at 40 mm
AxisX:funOut   = 7                ; output: codeM 1000 and in synchronism, the tool comes down
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
    CALL Program
    AxisX:positm = 0
    STARTCAM AxisX
    WAIT AxisX:st_camex
    ofCutting = 1
    gbPhase = 3
ENDIF
IF gbPhase EQ 3 AND NOT AxisX:st_camex
    ofCutting = 0                 ; the device left the cam by itself (error)
    gbPhase = 0
ENDIF
WAIT 1
JUMP MAIN

;-----
; The cam: nine sectors, then one piece is taken off the master
;-----
SUB Program
    ; 1: from rest to web speed
    AxisX:codeG1  = 132
    AxisX:codeQm1 = cRunUp
    AxisX:codeQs1 = cRunUp / 2
    AxisX:codeM1  = 0
    ; 2: cut
    AxisX:codeG2  = 133
    AxisX:codeQm2 = cCut
    AxisX:codeQs2 = cCut
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
    ; 5: back to web speed
    AxisX:codeG5  = 133
    AxisX:codeQm5 = cSpeedUp
    AxisX:codeQs5 = cSpeedUpS
    AxisX:codeM5  = 0
    ; 6: stop
    AxisX:codeG6  = 135
    AxisX:codeQm6 = cStop
    AxisX:codeQs6 = cStop / 2
    AxisX:codeM6  = 0
    ; 7 to 9: home in the rest of the piece, a quarter of it for each ramp
    glOut  = cRunUp / 2 + cCut + 2 * cSpeedUpS + cAwayS + cStop / 2
    glBack = slLength - cRunUp - cCut - 2 * cSpeedUp - cAway - cStop
    glRampM = glBack / 4
    glRampS = glOut / 6
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

;-----
; Wire guide, see wire_guide.cnf. Set slPitch, slFirst and slWidth before the start.
;-----
; Set-up of the axis: screw lead 20 mm, 10000 bits a turn of the motor; spool encoder 10000 bits a turn;
; 10 V = 2000 rpm of the motor = 40 m/min.
;-----
AxisX:decpt    = 2
AxisX:measure  = 2000
AxisX:pulse    = 10000
AxisX:measurem = 1000
AxisX:pulsem   = 10000
AxisX:unitvel  = 0                ; speeds in mm/min
AxisX:maxvel   = 40000
AxisX:setvel   = 10000
AxisX:prsvel   = 6000
AxisX:sprsvel  = 1200
AxisX:tacc     = 60
AxisX:tdec     = 60
AxisX:taccmax  = 20
AxisX:tdecmax  = 20
AxisX:minpos   = 0
AxisX:maxpos   = 100000
AxisX:toll     = 2
AxisX:syncrange = 10
AxisX:maxfollerr = 1000
AxisX:ramptype = 1
AxisX:rtype    = 1
AxisX:prsmode  = 1                ; home switch, then the zero pulse of the motor
AxisX:prsdir   = 1
AxisX:prspos   = 2000             ; the zero pulse behind the switch is at 20 mm
AxisX:funOut   = 5                ; output: in synchronism
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
; Home, then to the first flange
;-----
gbPhase = 1
PRESET AxisX
WAIT AxisX:st_prsok
AxisX:setvel = 10000
AxisX:setpos = slFirst
START AxisX
WAIT AxisX:st_toll AND AxisX:st_still
gbPhase = 2

MAIN:
IF gbPhase EQ 2 AND ifStart
    CALL Program
    AxisX:positm = 0
    STARTCAM AxisX
    WAIT AxisX:st_camex
    ofWinding = 1
    gbPhase = 3
ENDIF
IF gbPhase EQ 3 AND NOT AxisX:st_camex
    ofWinding = 0                 ; the device left the cam by itself (error)
    gbPhase = 0
ENDIF
WAIT 1
JUMP MAIN

;-----
; The cam: out in three sectors, rest, back in three sectors, rest; then the spool's turns are taken off.
; At constant speed the guide goes slPitch for 1000 of the master; a ramp from rest to that speed takes half
; of it for the same turn of the spool.
;-----
SUB Program
    glRampS = cRamp * slPitch / 2000
    glTravelM = (slWidth - 2 * glRampS) * 1000 / slPitch
    ; 1: up to the speed of the pitch
    AxisX:codeG1  = 131
    AxisX:codeQm1 = cRamp
    AxisX:codeQs1 = glRampS
    ; 2: pitch
    AxisX:codeG2  = 133
    AxisX:codeQm2 = glTravelM
    AxisX:codeQs2 = slWidth - 2 * glRampS
    ; 3: stop at the flange
    AxisX:codeG3  = 135
    AxisX:codeQm3 = cRamp
    AxisX:codeQs3 = glRampS
    ; 4: rest
    AxisX:codeG4  = 133
    AxisX:codeQm4 = cRest
    AxisX:codeQs4 = 0
    ; 5 to 8: the same on the way back
    AxisX:codeG5  = 131
    AxisX:codeQm5 = cRamp
    AxisX:codeQs5 = - glRampS
    AxisX:codeG6  = 133
    AxisX:codeQm6 = glTravelM
    AxisX:codeQs6 = 2 * glRampS - slWidth
    AxisX:codeG7  = 135
    AxisX:codeQm7 = cRamp
    AxisX:codeQs7 = - glRampS
    AxisX:codeG8  = 133
    AxisX:codeQm8 = cRest
    AxisX:codeQs8 = 0
    ; 9, 10: take the cycle off the master, the guide is where it began
    AxisX:codeG9  = 139
    AxisX:codeQm9 = 2 * (2 * cRamp + glTravelM + cRest)
    AxisX:codeQs9 = 0
    AxisX:codeG10 = 137
    AxisX:codeQm10 = 1
ENDSUB
END

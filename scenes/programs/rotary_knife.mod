;-----
; Rotary knife, see rotary_knife.cnf. Set slLength before the start.
;-----
; Set-up of the axis: 8192 bits a turn of the motor, gear 5:1, 600 mm a turn of the drum;
; measuring wheel 10000 bits for 500 mm; 10 V = 2000 rpm of the motor = 240 m/min of the blade.
;-----
AxisX:decpt    = 1
AxisX:measure  = 6000
AxisX:pulse    = 40960
AxisX:measurem = 5000
AxisX:pulsem   = 10000
AxisX:unitvel  = 0                ; speeds in mm/min
AxisX:maxvel   = 240000
AxisX:setvel   = 10000            ; placements, as fast as the motor can brake within tdec
AxisX:prsvel   = 20000
AxisX:sprsvel  = 2000
AxisX:tacc     = 100              ; 1 s from 0 to maxvel
AxisX:tdec     = 25               ; 0.25 s from maxvel to 0: STOPCAM must end before the next cut
AxisX:taccmax  = 50
AxisX:tdecmax  = 50
AxisX:minpos   = - 999999
AxisX:maxpos   = 999999
AxisX:toll     = 5
AxisX:syncrange = 10
AxisX:maxfollerr = 1000
AxisX:ramptype = 1                ; epicycloidal placements
AxisX:rtype    = 1
AxisX:prsmode  = 1                ; home switch, then the encoder's zero pulse
AxisX:prsdir   = 0
AxisX:prspos   = - 600            ; the zero pulse lies 60 mm before the blade's top
AxisX:funOut   = 5                ; output: in synchronism
IF AxisX:pgain EQ 0               ; gains, unless the commissioning has set them
    AxisX:pgain  = 50
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
AxisX:setvel = 10000
AxisX:setpos = 0
START AxisX
WAIT AxisX:st_toll AND AxisX:st_still
gbPhase = 2

MAIN:
IF gbPhase EQ 2 AND ifStart
    IF slZone EQ 0
        CALL Program
    ENDIF
    STARTCAM AxisX
    WAIT AxisX:st_camex
    ofCutting = 1
    gbPhase = 3
ENDIF
; Stop: only while the blade is on its way over the top, so that it never brakes inside the web
IF gbPhase EQ 3 AND NOT ifStart AND (AxisX:rowex EQ 4 OR AxisX:rowex EQ 5) AND AxisX:posit LT cCircum
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
    AxisX:setvel = 10000
    AxisX:setpos = cCircum
    START AxisX
    WAIT AxisX:st_toll AND AxisX:st_still
    AxisX:posit = AxisX:posit - cCircum
    gbPhase = 2
ENDIF
WAIT 1
JUMP MAIN

;-----
; The cam. Blade on top at the start; it meets the web half a turn later.
;-----
SUB Program
    ; 1: up to the speed of the web
    AxisX:codeG1  = 232
    AxisX:codeQm1 = 3000
    AxisX:codeQs1 = 1500
    AxisX:codeM1  = 0
    ; 2: at web speed until the cut zone
    AxisX:codeG2  = 133
    AxisX:codeQm2 = cCircum / 2 - 1500 - cCutZone / 2
    AxisX:codeQs2 = cCircum / 2 - 1500 - cCutZone / 2
    AxisX:codeM2  = 0
    ; 3: cut zone
    AxisX:codeG3  = 133
    AxisX:codeQm3 = cCutZone
    AxisX:codeQs3 = cCutZone
    AxisX:codeM3  = 1000
    IF slLength GT cStopLen
        ; 4 to 6: stop on top, wait for the web, up to its speed again
        AxisX:codeG4  = 235
        AxisX:codeQm4 = cCircum - cCutZone
        AxisX:codeQs4 = (cCircum - cCutZone) / 2
        AxisX:codeG5  = 133
        AxisX:codeQm5 = slLength - cStopLen
        AxisX:codeQs5 = 0
        AxisX:codeG6  = 232
        AxisX:codeQm6 = cCircum - cCutZone
        AxisX:codeQs6 = (cCircum - cCutZone) / 2
    ELSE
        ; 4: the rest of the turn in the rest of the piece, slower or faster than the web
        AxisX:codeG4  = 234
        AxisX:codeQm4 = slLength - cCutZone
        AxisX:codeQs4 = cCircum - cCutZone
        AxisX:codeG5  = 130
        AxisX:codeG6  = 130
    ENDIF
    ; 7, 8: take one piece off the master and one turn off the slave, next piece
    AxisX:codeG7  = 139
    AxisX:codeQm7 = slLength
    AxisX:codeQs7 = cCircum
    AxisX:codeG8  = 137
    AxisX:codeQm8 = 3
ENDSUB
END

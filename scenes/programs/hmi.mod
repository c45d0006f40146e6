;-----
; The HMI of the rotary knife, a task beside rotary_knife.mod. Registers of Modbus, unit 1, addresses from 0:
;   written by 6 or 16
;       0   piece length [0.1 mm], from 450 mm to 3 m, else ignored; acts at the next start
;   read by 3 or 4
;       0   length of the next start [0.1 mm]
;       1   0 not homed, 1 homing, 2 ready, 3 cutting, 4 going back on top
;       2   sector of the cam
;       3   following error [bits x4]
;       4   speed of the web [0.1 m/min]
;-----
hmi:mode   = 1                    ; slave
hmi:idcard = 1
OPENCOM hmi
WAIT hmi:st_opencom

MAIN:
IF hmi:st_msgrx
    IF hmi:iword1 GE 4500 AND hmi:iword1 LE 30000
        slLength = hmi:iword1
    ENDIF
    RECEIVED hmi
    WAIT NOT hmi:st_msgrx
ENDIF
hmi:oword1 = slLength
hmi:oword2 = gbPhase
hmi:oword3 = AxisX:rowex
hmi:oword4 = AxisX:follerr
hmi:oword5 = AxisX:frqm * 12 / 100 ; 1 Hz of a phase is 4 bits of 0.05 mm a second
WAIT 1
JUMP MAIN
END

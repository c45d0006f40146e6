; expect: 6:1: cannot be assigned
; expect: 7:1: cannot be assigned
; expect: 8:7: only the device changes it
; expect: 9:7: is read-only

cLimit = 5
ifStart = 1
AxisX:st_init = 1
AxisX:rowex = 3
END

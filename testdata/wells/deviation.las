~Version Information
VERS.   2.0 : CWLS log ASCII standard, version 2.0
WRAP.   YES : several lines a depth step
~Well Information
STRT.FT     0.0 : first depth
STOP.FT  3000.0 : last depth
STEP.FT     0.0 : not constant
NULL.   -999.25 : undefined
WELL.     C-3   : name at 12:00
XCOORD.M 1000.0 : head
YCOORD.M 2000.0 : head
EKB.FT    100.0 : elevation of the kelly bushing
~Curve Information
DEPT.FT         : measured depth
GR  .GAPI       : gamma ray
DEVI.DEG        : deviation
AZIM.DEG        : azimuth
~A
   0.0
  55.1 0.0 0.0
1000.0
  60.2 0.0 0.0
1500.0
-999.25 -999.25 -999.25
2000.0
  58.9 45.0 90.0
3000.0
  71.0 45.0 90.0

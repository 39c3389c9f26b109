Section Conversion factors
Subclass p3at ; type
AngleConvFactor 0.00153
DistConvFactor 0.46500
VelConvFactor 1.0
RangeConvFactor 1.0
DiffConvFactor 0.0034
SonarUnit 0 147 136 90
SonarUnit 15 -144 136 90

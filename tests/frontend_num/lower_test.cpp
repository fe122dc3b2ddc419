#include <gtest/gtest.h>

#include "tests/frontend_num/read.h"
using namespace cnctrans;
using namespace cnctrans::frontends::num::testing;
TEST(NumLower, Look) {
  const auto o = read(R"(%12 (FLANGE)
N10 G0 G52 Z
G X5 Y-3.50 (comment) (two)
T1 D1 M6
L1=2+3*5 L2=S30 G1 X L1 Y-L2 M5 M3 F200 S L1
G79 L1<5 N10
G77 N10 N20 S3
G77 H100
G2 X10 Y0 I5 J0
G90 X5 G91 Y3
G1 X7 G91 Y3
G90
G81 X10 Y10 Z-5 ER2 EF1
X20
ER10
G80
G83 Z-23 P10 Q6 ER1 EH0.5
G80 G4 F1.5
G59 X10 Y L1
E60001=600 E80000=L1/3
IF L1=5 THEN
L2=3
ELSE
G0 X3 EB2
ENDI
VAR
[A]=E50001/1000
ENDV
G79 [A]>3 N10
$ HELLO
N20 M2
)");
  std::cout << body(o) << o.messages;
}

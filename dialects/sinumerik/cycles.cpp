#include "dialects/sinumerik/cycles.h"

namespace cnctrans::sinumerik {

namespace {

using enum CycleFamily;

constexpr CycleRow cycle_rows[] = {
    // 18.1 drilling
    {"CYCLE81", drilling, true, "RTP,RFP,SDIS,DP,DPR,DTB,GMODE,DMODE,AMODE"},
    {"CYCLE82", drilling, true, "RTP,RFP,SDIS,DP,DPR,DTB,GMODE,DMODE,AMODE"},
    {"CYCLE83", drilling, true,
     "RTP,RFP,SDIS,DP,DPR,FDEP,FDPR,DAM,DTB,DTS,FRF,VARI,AXN,MDEP,VRT,DTD,DIS1,GMODE,DMODE,AMODE"},
    {"CYCLE84", drilling, true,
     "RTP,RFP,SDIS,DP,DPR,DTB,SDAC,MPIT,PIT,POSS,SST,SST1,AXN,PITA,TECHNO,VARI,DAM,VRT,PITM,PTAB,PTABA,GMODE,DMODE,"
     "AMODE"},
    {"CYCLE840", drilling, true, "RTP,RFP,SDIS,DP,DPR,DTB,SDR,SDAC,ENC,MPIT,PIT,AXN"},
    {"CYCLE85", drilling, true, "RTP,RFP,SDIS,DP,DPR,DTB,FFR,RFF,GMODE,DMODE,AMODE"},
    {"CYCLE86", drilling, true, "RTP,RFP,SDIS,DP,DPR,DTB,SDIR,RPA,RPO,RPAP,POSS,GMODE,DMODE,AMODE"},
    {"CYCLE87", drilling, true, "RTP,RFP,SDIS,DP,DPR,SDIR"},
    {"CYCLE88", drilling, true, "RTP,RFP,SDIS,DP,DPR,DTB,SDIR"},
    {"CYCLE89", drilling, true, "RTP,RFP,SDIS,DP,DPR,DTB,GMODE,DMODE,AMODE"},
    // 18.2 patterns
    {"HOLES1", pattern, true, "SPCA,SPCO,STA1,FDIS,DBH,NUM"},
    {"HOLES2", pattern, true, "CPA,CPO,RAD,STA1,INDA,NUM"},
    {"CYCLE801", pattern, true, "SPCA,SPCO,STA,DIS1,DIS2,NUM1,NUM2,VARI,UMODE,ANG1,ANG2,HIDE,NSP,DMODE"},
    {"CYCLE802", pattern, true, "XA,YA,X0,Y0,X1,Y1,X2,Y2,X3,Y3,X4,Y4,X5,Y5,X6,Y6,X7,Y7,X8,Y8,VARI,UMODE,DMODE"},
    // 18.3 milling
    {"LONGHOLE", milling, true,
     "RTP,RFP,SDIS,DP,DPR,NUM,LENG,CPA,CPO,RAD,STA1,INDA,FFD,FFP1,MID,VARI,UMODE,GMODE,DMODE,AMODE"},
    {"SLOT1", milling, true,
     "RTP,RFP,SDIS,DP,DPR,NUM,LENG,WID,CPA,CPO,RAD,STA1,INDA,FFD,FFP1,MID,CDIR,FAL,VARI,MIDF,FFP2,SSF,FALD,STA2,DP1,"
     "UMODE,FS,ZFS,GMODE,DMODE,AMODE"},
    {"SLOT2", milling, true,
     "RTP,RFP,SDIS,DP,DPR,NUM,AFSL,WID,CPA,CPO,RAD,STA1,INDA,FFD,FFP1,MID,CDIR,FAL,VARI,MIDF,FFP2,SSF,FFCP,UMODE,FS,"
     "ZFS,GMODE,DMODE,AMODE"},
    {"POCKET1", milling, true,
     "RTP,RFP,SDIS,DP,DPR,LENG,WID,CRAD,CPA,CPO,STA1,FFD,FFP1,MID,CDIR,FAL,VARI,MIDF,FFP2,SSF"},
    {"POCKET2", milling, true, "RTP,RFP,SDIS,DP,DPR,PRAD,CPA,CPO,FFD,FFP1,MID,CDIR,FAL,VARI,MIDF,FFP2,SSF"},
    {"POCKET3", milling, true,
     "RTP,RFP,SDIS,DP,LENG,WID,CRAD,PA,PO,STA,MID,FAL,FALD,FFP1,FFD,CDIR,VARI,MIDA,AP1,AP2,AD,RAD1,DP1,UMODE,FS,ZFS,"
     "GMODE,DMODE,AMODE"},
    {"POCKET4", milling, true,
     "RTP,RFP,SDIS,DP,PRAD,PA,PO,MID,FAL,FALD,FFP1,FFD,CDIR,VARI,MIDA,AP1,AD,RAD1,DP1,UMODE,FS,ZFS,GMODE,DMODE,AMODE"},
    {"CYCLE60", milling, false, "TEXT,RTP,RFP,SDIS,DP,DPR,PA,PO,STA,CP1,CP2,WID,DF,FFD,FFP1,VARI,CODEP"},
    {"CYCLE61", milling, true, "RTP,RFP,SDIS,DP,PA,PO,LENG,WID,MID,MIDA,FALD,FFP1,VARI,LIM,DMODE,AMODE"},
    {"CYCLE62", milling, true, "KNAME,TYPE,LAB1,LAB2"},
    {"CYCLE63", milling, false, "PRG,VARI,RP,Z0,SC,Z1,F,FZ,DXY,DZ,UXY,UZ,CDIR,XS,YS,ER,EP,EW,FS,ZFS,TR,DR"},
    {"CYCLE64", milling, false, "PRG,VARI,RP,Z0,SC,Z1,F,DXY,UXY,UZ,CDIR,TR,DR"},
    {"CYCLE70", milling, false, "RTP,RFP,SDIS,DP,DPR,DIATH,KDIAM,PIT,FFR,CDIR,TYPTH,CPA,CPO"},
    {"CYCLE71", milling, true, "RTP,RFP,SDIS,DP,PA,PO,LENG,WID,STA,MID,MIDA,FDP,FALD,FFP1,VARI,FDP1"},
    {"CYCLE72", milling, true,
     "KNAME,RTP,RFP,SDIS,DP,MID,FAL,FALD,FFP1,FFD,VARI,RL,AS1,LP1,FF3,AS2,LP2,UMODE,FS,ZFS,GMODE,DMODE,AMODE"},
    {"CYCLE73", milling, false, ""},
    {"CYCLE74", milling, false, ""},
    {"CYCLE75", milling, false, ""},
    {"CYCLE76", milling, true,
     "RTP,RFP,SDIS,DP,DPR,LENG,WID,CRAD,PA,PO,STA,MID,FAL,FALD,FFP1,FFD,CDIR,VARI,AP1,AP2,FS,ZFS,GMODE,DMODE,AMODE"},
    {"CYCLE77", milling, true,
     "RTP,RFP,SDIS,DP,DPR,PRAD,PA,PO,MID,FAL,FALD,FFP1,FFD,CDIR,VARI,AP1,FS,ZFS,GMODE,DMODE,AMODE"},
    {"CYCLE78", milling, false, ""},
    {"CYCLE79", milling, false, ""},
    {"CYCLE899", milling, false, ""},
    {"CYCLE90", milling, true, "RTP,RFP,SDIS,DP,DPR,DIATH,KDIAM,PIT,FFR,CDIR,TYPTH,CPA,CPO"},
    // 18.4 turning
    {"CYCLE92", turning, true, "SPD,SPL,DIAG1,DIAG2,RC,SDIS,SV1,SV2,SDAC,FF1,FF2,SS2,DIAGM,VARI,DN,DMODE,AMODE"},
    {"CYCLE93", turning, true, "SPD,SPL,WIDG,DIAG,STA1,ANG1,ANG2,RCO1,RCO2,RCI1,RCI2,FAL1,FAL2,IDEP,DTB,VARI,VRT,DN"},
    {"CYCLE94", turning, true, "SPD,SPL,FORM,VARI"},
    {"CYCLE95", turning, true, "NPP,MID,FALZ,FALX,FAL,FF1,FF2,FF3,VARI,DT,DAM,VRT"},
    {"CYCLE96", turning, true, "DIATH,SPL,FORM,VARI"},
    {"CYCLE97", turning, true, "PIT,MPIT,SPL,FPL,DM1,DM2,APP,ROP,TDEP,FAL,IANG,NSP,NRC,NID,VARI,NUMT,VRT"},
    {"CYCLE98", turning, true,
     "PO1,DM1,PO2,DM2,PO3,DM3,PO4,DM4,APP,ROP,TDEP,FAL,IANG,NSP,NRC,NID,PP1,PP2,PP3,VARI,NUMT,VRT"},
    {"CYCLE99", turning, true,
     "SPL,SPD,FPL,FPD,APP,ROP,TDEP,FAL,IANG,NSP,NRC,NID,PIT,VARI,NUMT,SDIS,MID,GDEP,PIT1,FDEP,GST,GUD,IFLANK,PITA,PITM,"
     "PTAB,PTABA,DMODE,AMODE"},
    {"CYCLE930", turning, true,
     "SPD,SPL,WIDG,WIDG2,DIAG,DIAG2,STA,ANG1,ANG2,RCO1,RCI1,RCI2,RCO2,FAL,IDEP1,SDIS,VARI,DN,NUM,DBH,FF1,NR,FALX,FALZ,"
     "DMODE,AMODE"},
    {"CYCLE940", turning, true,
     "SPD,SPL,FORM,LAGE,SDIS,FFP,VARI,EPD,EPL,R1,R2,STA,VRT,MID,FAL,FALX,FALZ,PITI,PTAB,PTABA,DMODE,AMODE"},
    {"CYCLE951", turning, true, "SPD,SPL,EPD,EPL,ZPD,ZPL,LAGE,MID,FALX,FALZ,VARI,RF1,RF2,RF3,SDIS,FF1,NR,DMODE,AMODE"},
    {"CYCLE952", turning, false, ""},
    // 18.5 other
    {"CYCLE800", swivel, false, "FR,TC,ST,MODE,X0,Y0,Z0,A,B,C,X1,Y1,Z1,DIR,FR_I,DMODE"},
    {"CYCLE961", measuring, false, ""},
    {"CYCLE971", measuring, false, ""},
    {"CYCLE972", measuring, false, ""},
    {"CYCLE973", measuring, false, ""},
    {"CYCLE974", measuring, false, ""},
    {"CYCLE976", measuring, false, ""},
    {"CYCLE977", measuring, false, ""},
    {"CYCLE978", measuring, false, ""},
    {"CYCLE979", measuring, false, ""},
    {"CYCLE982", measuring, false, ""},
    {"CYCLE994", measuring, false, ""},
    {"CYCLE995", measuring, false, ""},
    {"CYCLE996", measuring, false, ""},
    {"CYCLE997", measuring, false, ""},
    {"CYCLE998", measuring, false, ""},
};

constexpr PatternRow pattern_rows[] = {
    {"HOLES1", "points.row", "u,v,angle,first,step,count"},
    {"HOLES2", "points.ring", "u,v,radius,angle,angle_step,count"},
    {"CYCLE801", "points.matrix", "u,v,angle,step,step2,count,count2"},
    {"CYCLE801", "points.frame", "u,v,angle,step,step2,count,count2"},
    {"CYCLE802", "points.list", "u1,v1,u2,v2,u3,v3,u4,v4,u5,v5,u6,v6,u7,v7,u8,v8,u9,v9"},
};

/// Coarse pitch series of the metric thread (ISO 261), first choice sizes and the usual ones between.
struct Thread {
  double size, pitch;
};
constexpr Thread threads[] = {
    {3, 0.5},   {3.5, 0.6}, {4, 0.7}, {5, 0.8},  {6, 1},    {7, 1},    {8, 1.25}, {10, 1.5},
    {12, 1.75}, {14, 2},    {16, 2},  {18, 2.5}, {20, 2.5}, {22, 2.5}, {24, 3},   {27, 3},
    {30, 3.5},  {33, 3.5},  {36, 4},  {39, 4},   {42, 4.5}, {45, 4.5}, {48, 5},
};

}  // namespace

std::span<const PatternRow> patterns() {
  return pattern_rows;
}

double coarse_pitch(double size) {
  for (const auto& t : threads) {
    if (t.size == size) return t.pitch;
  }
  return 0;
}

std::span<const CycleRow> cycles() {
  return cycle_rows;
}

const CycleRow* cycle(std::string_view capitals) {
  for (const auto& r : cycle_rows) {
    if (r.name == capitals) return &r;
  }
  return nullptr;
}

int parameter_index(const CycleRow& row, std::string_view name) {
  return parameter_index(row.parameters, name);
}

int parameter_index(std::string_view rest, std::string_view name) {
  for (int i = 0; !rest.empty(); ++i) {
    const std::size_t comma = rest.find(',');
    if (rest.substr(0, comma) == name) return i;
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  return -1;
}

}  // namespace cnctrans::sinumerik

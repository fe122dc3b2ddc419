#include "dialects/sinumerik/cycles.h"

namespace cnctrans::sinumerik {

namespace {

using enum CycleFamily;

constexpr CycleRow rows[] = {
    // 18.1 drilling
    {"CYCLE81", drilling, true, "RTP,RFP,SDIS,DP,DPR,DTB,GMODE,DMODE,AMODE"},
    {"CYCLE82", drilling, true, "RTP,RFP,SDIS,DP,DPR,DTB,GMODE,DMODE,AMODE"},
    {"CYCLE83", drilling, true,
     "RTP,RFP,SDIS,DP,DPR,FDEP,FDPR,DAM,DTB,DTS,FRF,VARI,AXN,MDEP,VRT,DTD,DIS1,GMODE,DMODE,AMODE"},
    {"CYCLE84", drilling, false,
     "RTP,RFP,SDIS,DP,DPR,DTB,SDAC,MPIT,PIT,POSS,SST,SST1,AXN,PITA,TECHNO,VARI,DAM,VRT,PITM,PTAB,PTABA,GMODE,DMODE,"
     "AMODE"},
    {"CYCLE840", drilling, false, "RTP,RFP,SDIS,DP,DPR,DTB,SDR,SDAC,ENC,MPIT,PIT,AXN"},
    {"CYCLE85", drilling, false, "RTP,RFP,SDIS,DP,DPR,DTB,FFR,RFF"},
    {"CYCLE86", drilling, false, "RTP,RFP,SDIS,DP,DPR,DTB,SDIR,RPA,RPO,RPAP,POSS"},
    {"CYCLE87", drilling, false, "RTP,RFP,SDIS,DP,DPR,SDIR"},
    {"CYCLE88", drilling, false, "RTP,RFP,SDIS,DP,DPR,DTB,SDIR"},
    {"CYCLE89", drilling, false, "RTP,RFP,SDIS,DP,DPR,DTB"},
    // 18.2 patterns
    {"HOLES1", pattern, false, "SPCA,SPCO,STA1,FDIS,DBH,NUM"},
    {"HOLES2", pattern, false, "CPA,CPO,RAD,STA1,INDA,NUM"},
    {"CYCLE801", pattern, false, "SPCA,SPCO,STA,DIS1,DIS2,NUM1,NUM2,VARI,UMODE,ANG1,ANG2,HIDE,NSP,DMODE"},
    {"CYCLE802", pattern, false, ""},
    // 18.3 milling
    {"LONGHOLE", milling, false, "RTP,RFP,SDIS,DP,DPR,NUM,LENG,CPA,CPO,RAD,STA1,INDA,FFD,FFP1,MID"},
    {"SLOT1", milling, false,
     "RTP,RFP,SDIS,DP,DPR,NUM,LENG,WID,CPA,CPO,RAD,STA1,INDA,FFD,FFP1,MID,CDIR,FAL,VARI,MIDF,FFP2,SSF,FALD,STA2"},
    {"SLOT2", milling, false,
     "RTP,RFP,SDIS,DP,DPR,NUM,AFSL,WID,CPA,CPO,RAD,STA1,INDA,FFD,FFP1,MID,CDIR,FAL,VARI,MIDF,FFP2,SSF"},
    {"POCKET1", milling, false,
     "RTP,RFP,SDIS,DP,DPR,LENG,WID,CRAD,CPA,CPO,STA1,FFD,FFP1,MID,CDIR,FAL,VARI,MIDF,FFP2,SSF"},
    {"POCKET2", milling, false, "RTP,RFP,SDIS,DP,DPR,PRAD,CPA,CPO,FFD,FFP1,MID,CDIR,FAL,VARI,MIDF,FFP2,SSF"},
    {"POCKET3", milling, false,
     "RTP,RFP,SDIS,DP,LENG,WID,CRAD,PA,PO,STA,MID,FAL,FALD,FFP1,FFD,CDIR,VARI,MIDA,AP1,AP2,AD,RAD1,DP1"},
    {"POCKET4", milling, false, "RTP,RFP,SDIS,DP,PRAD,PA,PO,MID,FAL,FALD,FFP1,FFD,CDIR,VARI,MIDA,AP1,AD,RAD1,DP1"},
    {"CYCLE60", milling, false, "TEXT,RTP,RFP,SDIS,DP,DPR,PA,PO,STA,CP1,CP2,WID,DF,FFD,FFP1,VARI,CODEP"},
    {"CYCLE61", milling, false, "RTP,RFP,SDIS,DP,PA,PO,LENG,WID,STA,MID,MIDA,FDP,FALD,FFP1,VARI,FDP1"},
    {"CYCLE62", milling, false, "KNAME,TYPE,LAB1,LAB2"},
    {"CYCLE63", milling, false, "PRG,VARI,RP,Z0,SC,Z1,F,FZ,DXY,DZ,UXY,UZ,CDIR,XS,YS,ER,EP,EW,FS,ZFS,TR,DR"},
    {"CYCLE64", milling, false, "PRG,VARI,RP,Z0,SC,Z1,F,DXY,UXY,UZ,CDIR,TR,DR"},
    {"CYCLE70", milling, false, "RTP,RFP,SDIS,DP,DPR,DIATH,KDIAM,PIT,FFR,CDIR,TYPTH,CPA,CPO"},
    {"CYCLE71", milling, false, "RTP,RFP,SDIS,DP,PA,PO,LENG,WID,STA,MID,MIDA,FDP,FALD,FFP1,VARI,FDP1"},
    {"CYCLE72", milling, false, "KNAME,RTP,RFP,SDIS,DP,MID,FAL,FALD,FFP1,FFD,VARI,RL,AS1,LP1,FF3,AS2,LP2"},
    {"CYCLE73", milling, false, ""},
    {"CYCLE74", milling, false, ""},
    {"CYCLE75", milling, false, ""},
    {"CYCLE76", milling, false, "RTP,RFP,SDIS,DP,DPR,LENG,WID,CRAD,PA,PO,STA,MID,FAL,FALD,FFP1,FFD,CDIR,VARI,AP1,AP2"},
    {"CYCLE77", milling, false, "RTP,RFP,SDIS,DP,DPR,PRAD,PA,PO,MID,FAL,FALD,FFP1,FFD,CDIR,VARI,AP1"},
    {"CYCLE78", milling, false, ""},
    {"CYCLE79", milling, false, ""},
    {"CYCLE899", milling, false, ""},
    {"CYCLE90", milling, false, "RTP,RFP,SDIS,DP,DPR,DIATH,KDIAM,PIT,FFR,CDIR,TYPTH,CPA,CPO"},
    // 18.4 turning
    {"CYCLE92", turning, false, "SPD,SPL,DIAG1,DIAG2,RC,SDIS,SV1,SV2,SDAC,FF1,FF2,SS2,DIAGM,VARI,DN,DMODE,AMODE"},
    {"CYCLE93", turning, false, "SPD,SPL,WIDG,DIAG,STA1,ANG1,ANG2,RCO1,RCO2,RCI1,RCI2,FAL1,FAL2,IDEP,DTB,VARI,VRT"},
    {"CYCLE94", turning, false, "SPD,SPL,FORM,VARI"},
    {"CYCLE95", turning, true, "NPP,MID,FALZ,FALX,FAL,FF1,FF2,FF3,VARI,DT,DAM,VRT"},
    {"CYCLE96", turning, false, "DIATH,SPL,FORM,VARI"},
    {"CYCLE97", turning, true, "PIT,MPIT,SPL,FPL,DM1,DM2,APP,ROP,TDEP,FAL,IANG,NSP,NRC,NID,VARI,NUMT,VRT"},
    {"CYCLE98", turning, false,
     "PO1,DM1,PO2,DM2,PO3,DM3,PO4,DM4,APP,ROP,TDEP,FAL,IANG,NSP,NRC,NID,PP1,PP2,PP3,VARI,NUMT,VRT"},
    {"CYCLE99", turning, false,
     "SPL,SPD,FPL,FPD,APP,ROP,TDEP,FAL,IANG,NSP,NRC,NID,PIT,VARI,NUMT,SDIS,MID,GDEP,PIT1,FDEP,GST,GUD,IFLANK,PITA,PITM,"
     "PTAB,PTABA,DMODE,AMODE"},
    {"CYCLE930", turning, false,
     "SPD,SPL,WIDG,WIDG2,DIAG,DIAG2,STA,ANG1,ANG2,RCO1,RCI1,RCI2,RCO2,FAL,IDEP1,SDIS,VARI,DN,NUM,DBH,FF1,NR,FALX,FALZ,"
     "DMODE,AMODE"},
    {"CYCLE940", turning, false,
     "SPD,SPL,FORM,LAGE,SDIS,FFP,VARI,EPD,EPL,R1,R2,STA,VRT,MID,FAL,FALX,FALZ,PITI,PTAB,PTABA,DMODE,AMODE"},
    {"CYCLE951", turning, false, "SPD,SPL,EPD,EPL,ZPD,ZPL,LAGE,MID,FALX,FALZ,VARI,RF1,RF2,RF3,SDIS,FF1,NR,DMODE,AMODE"},
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

}  // namespace

std::span<const CycleRow> cycles() {
  return rows;
}

const CycleRow* cycle(std::string_view capitals) {
  for (const auto& r : rows) {
    if (r.name == capitals) return &r;
  }
  return nullptr;
}

int parameter_index(const CycleRow& row, std::string_view name) {
  std::string_view rest = row.parameters;
  for (int i = 0; !rest.empty(); ++i) {
    const std::size_t comma = rest.find(',');
    if (rest.substr(0, comma) == name) return i;
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  return -1;
}

}  // namespace cnctrans::sinumerik

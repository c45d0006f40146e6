#pragma once
#include "devices/epicpos/table.hpp"

namespace drycut::devices::epicpos {

// The rows of the tables by name, found while compiling.

/// Rows of the state table.
enum StateRow : int {
  st_init = table::row_of(table::states, "st_init"),
  st_emrg = table::row_of(table::states, "st_emrg"),
  st_toll = table::row_of(table::states, "st_toll"),
  st_prsok = table::row_of(table::states, "st_prsok"),
  st_still = table::row_of(table::states, "st_still"),
  st_prson = table::row_of(table::states, "st_prson"),
  st_movdir = table::row_of(table::states, "st_movdir"),
  st_loopon = table::row_of(table::states, "st_loopon"),
  st_foller = table::row_of(table::states, "st_foller"),
  st_regoff = table::row_of(table::states, "st_regoff"),
  st_cal = table::row_of(table::states, "st_cal"),
  st_cntlock = table::row_of(table::states, "st_cntlock"),
  st_cntrev = table::row_of(table::states, "st_cntrev"),
};

/// Rows of the command table.
enum CommandRow : int {
  c_INIT = table::row_of(table::commands, "INIT"),
  c_EMRG = table::row_of(table::commands, "EMRG"),
  c_RESUME = table::row_of(table::commands, "RESUME"),
  c_START = table::row_of(table::commands, "START"),
  c_STOP = table::row_of(table::commands, "STOP"),
  c_LOOPON = table::row_of(table::commands, "LOOPON"),
  c_LOOPOFF = table::row_of(table::commands, "LOOPOFF"),
  c_CNTLOCK = table::row_of(table::commands, "CNTLOCK"),
  c_CNTUNLOCK = table::row_of(table::commands, "CNTUNLOCK"),
  c_CNTREV = table::row_of(table::commands, "CNTREV"),
  c_CNTDIR = table::row_of(table::commands, "CNTDIR"),
  c_PRESET = table::row_of(table::commands, "PRESET"),
  c_CALON = table::row_of(table::commands, "CALON"),
  c_CALOFF = table::row_of(table::commands, "CALOFF"),
  c_MANFW = table::row_of(table::commands, "MANFW"),
  c_MANBW = table::row_of(table::commands, "MANBW"),
  c_REGOFF = table::row_of(table::commands, "REGOFF"),
  c_REGON = table::row_of(table::commands, "REGON"),
  c_DELCNT = table::row_of(table::commands, "DELCNT"),
};

/// Rows of the variable table: those that EPICPOS and EANPOS share, then each one's own.
enum VariableRow : int {
  v_cntratio = table::row_of(table::variables, "cntratio"),
  v_maxpos = table::row_of(table::variables, "maxpos"),
  v_minpos = table::row_of(table::variables, "minpos"),
  v_prspos = table::row_of(table::variables, "prspos"),
  v_maxvel = table::row_of(table::variables, "maxvel"),
  v_prsvel = table::row_of(table::variables, "prsvel"),
  v_sprsvel = table::row_of(table::variables, "sprsvel"),
  v_toll = table::row_of(table::variables, "toll"),
  v_maxfollerr = table::row_of(table::variables, "maxfollerr"),
  v_rampmode = table::row_of(table::variables, "rampmode"),
  v_taccdec = table::row_of(table::variables, "taccdec"),
  v_tacc = table::row_of(table::variables, "tacc"),
  v_tdec = table::row_of(table::variables, "tdec"),
  v_tinvt = table::row_of(table::variables, "tinvt"),
  v_toldly = table::row_of(table::variables, "toldly"),
  v_pgain = table::row_of(table::variables, "pgain"),
  v_feedfw = table::row_of(table::variables, "feedfw"),
  v_integt = table::row_of(table::variables, "integt"),
  v_derivt = table::row_of(table::variables, "derivt"),
  v_prsmode = table::row_of(table::variables, "prsmode"),
  v_prsdir = table::row_of(table::variables, "prsdir"),
  v_unitvel = table::row_of(table::variables, "unitvel"),
  v_decpt = table::row_of(table::variables, "decpt"),
  v_offset = table::row_of(table::variables, "offset"),
  v_setpos = table::row_of(table::variables, "setpos"),
  v_setvel = table::row_of(table::variables, "setvel"),
  v_vout = table::row_of(table::variables, "vout"),
  v_vel = table::row_of(table::variables, "vel"),
  v_frq = table::row_of(table::variables, "frq"),
  v_posit = table::row_of(table::variables, "posit"),
  v_follerr = table::row_of(table::variables, "follerr"),
  v_ffwdreg = table::row_of(table::variables, "ffwdreg"),
  v_propreg = table::row_of(table::variables, "propreg"),
  v_integ = table::row_of(table::variables, "integ"),
  v_derreg = table::row_of(table::variables, "derreg"),
  v_delta = table::row_of(table::variables, "delta"),
  v_shared = static_cast<int>(table::variables.size()),
  v_rtype = v_shared + table::row_of(table::epicpos_variables, "rtype"),
  v_stopt = v_shared + table::row_of(table::epicpos_variables, "stopt"),
  v_ramptype = v_shared + table::row_of(table::eanpos_variables, "ramptype"),
};

/// Fields of the .CNF record.
enum FieldRow : int {
  f_TCamp = table::row_of(table::fields, "TCamp"),
  f_ICont = table::row_of(table::fields, "ICont"),
  f_IntL = table::row_of(table::fields, "IntL"),
  f_IAZero = table::row_of(table::fields, "IAZero"),
  f_IOutA = table::row_of(table::fields, "IOutA"),
};

}  // namespace drycut::devices::epicpos

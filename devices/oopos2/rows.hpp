#pragma once
#include "devices/oopos2/table.hpp"

namespace drycut::devices::oopos2 {

// The rows of the tables by name, found while compiling.

/// Rows of the state table.
enum StateRow : int {
  st_init = table::row_of(table::states, "st_init"),
  st_cntlock = table::row_of(table::states, "st_cntlock"),
  st_cntrev = table::row_of(table::states, "st_cntrev"),
  st_movfwd = table::row_of(table::states, "st_movfwd"),
  st_movbwd = table::row_of(table::states, "st_movbwd"),
  st_movslow = table::row_of(table::states, "st_movslow"),
  st_toll = table::row_of(table::states, "st_toll"),
  st_brake = table::row_of(table::states, "st_brake"),
  st_movdir = table::row_of(table::states, "st_movdir"),
  st_still = table::row_of(table::states, "st_still"),
  st_erin = table::row_of(table::states, "st_erin"),
  st_sttoll = table::row_of(table::states, "st_sttoll"),
  st_prsok = table::row_of(table::states, "st_prsok"),
  st_prson = table::row_of(table::states, "st_prson"),
  st_regoff = table::row_of(table::states, "st_regoff"),
};

/// Rows of the command table.
enum CommandRow : int {
  c_INIT = table::row_of(table::commands, "INIT"),
  c_STOP = table::row_of(table::commands, "STOP"),
  c_START = table::row_of(table::commands, "START"),
  c_CNTLOCK = table::row_of(table::commands, "CNTLOCK"),
  c_CNTUNLOCK = table::row_of(table::commands, "CNTUNLOCK"),
  c_CNTREV = table::row_of(table::commands, "CNTREV"),
  c_CNTDIR = table::row_of(table::commands, "CNTDIR"),
  c_PRESET = table::row_of(table::commands, "PRESET"),
  c_MANSFW = table::row_of(table::commands, "MANSFW"),
  c_MANSBW = table::row_of(table::commands, "MANSBW"),
  c_MANFFW = table::row_of(table::commands, "MANFFW"),
  c_MANFBW = table::row_of(table::commands, "MANFBW"),
  c_REGON = table::row_of(table::commands, "REGON"),
  c_REGOFF = table::row_of(table::commands, "REGOFF"),
  c_DELCNT = table::row_of(table::commands, "DELCNT"),
};

/// Rows of the variable table; the other inertias follow iner01.
enum VariableRow : int {
  v_cntratio = table::row_of(table::variables, "cntratio"),
  v_posit = table::row_of(table::variables, "posit"),
  v_minpos = table::row_of(table::variables, "minpos"),
  v_maxpos = table::row_of(table::variables, "maxpos"),
  v_slowpos = table::row_of(table::variables, "slowpos"),
  v_tollp = table::row_of(table::variables, "tollp"),
  v_tolln = table::row_of(table::variables, "tolln"),
  v_tinvt = table::row_of(table::variables, "tinvt"),
  v_slowdly = table::row_of(table::variables, "slowdly"),
  v_tbrake = table::row_of(table::variables, "tbrake"),
  v_overpos = table::row_of(table::variables, "overpos"),
  v_bklashmode = table::row_of(table::variables, "bklashmode"),
  v_ninert = table::row_of(table::variables, "ninert"),
  v_maxiner = table::row_of(table::variables, "maxiner"),
  v_toldly = table::row_of(table::variables, "toldly"),
  v_inertmode = table::row_of(table::variables, "inertmode"),
  v_tool = table::row_of(table::variables, "tool"),
  v_setpos = table::row_of(table::variables, "setpos"),
  v_iner01 = table::row_of(table::variables, "iner01"),
  v_dobiner = table::row_of(table::variables, "dobiner"),
  v_enstol = table::row_of(table::variables, "enstol"),
  v_prsmode = table::row_of(table::variables, "prsmode"),
  v_prspos = table::row_of(table::variables, "prspos"),
  v_prsdir = table::row_of(table::variables, "prsdir"),
  v_actiner = table::row_of(table::variables, "actiner"),
  v_delta = table::row_of(table::variables, "delta"),
  v_decpt = table::row_of(table::variables, "decpt"),
  v_unitvel = table::row_of(table::variables, "unitvel"),
  v_frq = table::row_of(table::variables, "frq"),
  v_vel = table::row_of(table::variables, "vel"),
  v_breaktype = table::row_of(table::variables, "breaktype"),
  v_slowtype = table::row_of(table::variables, "slowtype"),
  v_maxvel = table::row_of(table::variables, "maxvel"),
  v_maxslow = table::row_of(table::variables, "maxslow"),
  v_minslow = table::row_of(table::variables, "minslow"),
  v_exeslow = table::row_of(table::variables, "exeslow"),
};

/// Fields of the .CNF record.
enum FieldRow : int {
  f_TCamp = table::row_of(table::fields, "TCamp"),
  f_IQCTL = table::row_of(table::fields, "IQCTL"),
  f_ILine = table::row_of(table::fields, "ILine"),
  f_IAZero = table::row_of(table::fields, "IAZero"),
  f_OutAva = table::row_of(table::fields, "OutAva"),
  f_OutInd = table::row_of(table::fields, "OutInd"),
  f_OutDir = table::row_of(table::fields, "OutDir"),
  f_OutMov = table::row_of(table::fields, "OutMov"),
  f_OutRal = table::row_of(table::fields, "OutRal"),
  f_OutFre = table::row_of(table::fields, "OutFre"),
};

}  // namespace drycut::devices::oopos2

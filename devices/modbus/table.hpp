#pragma once
#include <array>
#include <string_view>

#include "devices/device.hpp"

// The public face of MODBUS (wiki.qem.it, en:software:devices:modbus, as far as its pages could be read: the
// revisions of December 2016).
namespace drycut::devices::modbus::table {

using R = Retention;
using enum Access;

inline constexpr int words = 32;  ///< of each table: 512 bits
inline constexpr int longs = words / 2;

inline constexpr std::array states = {
    State{"st_init", R::zero, "the device runs", "6.3.4"},
    State{"st_msgrx", R::zero, "slave: the master has written into iword, until RECEIVED", "6.3.4"},
    State{"st_sended", R::one, "master: no message is under way", "5.10.4"},
    State{"st_opencom", R::zero, "the communication port is open", "6.3.4"},
    State{"err", R::zero, "master: the last message had no good answer", "5.9"},
    State{"wdata", R::zero, "a parameter was given a value that is not valid", "6.3.4"},
    State{"wcmd", R::zero, "a command was not executed, its conditions did not hold", "6.3.4"},
};

inline constexpr Needs<states> needs;
inline constexpr Turns<states, false> turns;
inline constexpr Turns<states, true> turns_quietly;

inline constexpr Condition may_send =
    needs({"st_init", "st_sended", "st_opencom"}, "mode = 0, 0 < num <= 128");

inline constexpr std::array commands = {
    elsewhere("6.3.5", command("INIT", needs({"!st_init"}), "starts the device", turns_quietly("st_init"))),
    elsewhere("5.10.5", command("SEND", may_send, "master: sends the message to the slave idcard",
                                turns("!st_sended"))),
    elsewhere("5.10.5",
              command("SENDSYC", may_send, "the same to a slave of QEM, synchronised", turns("!st_sended"))),
    elsewhere("6.3.5",
              command("RECEIVED", needs({"st_init"}), "slave: what came has been read", turns("!st_msgrx"))),
    elsewhere("6.3.5",
              command("OPENCOM", needs({"st_init"}), "opens the communication port", turns("st_opencom"))),
    elsewhere("6.3.5",
              command("CLOSECOM", needs({"st_init"}), "closes the communication port", turns("!st_opencom"))),
};

inline constexpr std::array exchanged = of_rows(
    words, std::array{
               zeroed("iword", Size::W, "", -32768, 32767, "what comes in, by words: a master writes it"),
               zeroed("oword", Size::W, "", -32768, 32767, "what goes out, by words: a master reads it"),
           });
inline constexpr std::array exchanged_longs = of_rows(
    longs,
    std::array{
        zeroed("ilong", Size::L, "", lowest, highest, "two words of what comes in: ilong1 is iword1, iword2"),
        zeroed("olong", Size::L, "", lowest, highest, "two words of what goes out: olong1 is oword1, oword2"),
    });
inline constexpr std::array parameters = {
    elsewhere("6.1", kept("mode", Size::B, "", 0, 2, "0 master, 1 and 2 slave")),
    elsewhere("6.1", kept("idcard", Size::W, "", 1, 247,
                          "slave: its own number; master: that of the slave it talks to")),
    elsewhere("5.10.2", kept("type", Size::B, "", 0, 127, "master: what the message does, 1 reads coils")),
    elsewhere("5.10.2", kept("addr", Size::L, "", 1, 65536, "master: the first of the slave's")),
    elsewhere("5.10.2", kept("num", Size::W, "", 0, 128, "master: how many")),
    elsewhere("5.10.2", kept("tabreg", Size::W, "", 1, 512, "master: where they stand in its own table")),
    elsewhere("6.3.3",
              zeroed("serr", Size::B, "", 0, 3, "serial errors: 0 none, 1 parity, 2 framing, 3 overrun")),
};
inline constexpr auto variables = in_section("4", joined(joined(parameters, exchanged), exchanged_longs));

inline constexpr std::array fields = {
    Field{"TCamp", Field::Kind::period_ms, 1, 255, "sampling time [ms]"},
    Field{"Port", Field::Kind::port, 0, 9, "communication port"},
};

inline constexpr std::string_view wiki = "wiki.qem.it devices/modbus";
inline constexpr std::array readings = {
    ManualReading{
        "", "the first MODBUS of the .CNF is what Modbus TCP of a live line reaches, whatever its port is",
        wiki},
    ManualReading{"INIT", "the device gives it to itself at power-up; a program's is taken without a word",
                  wiki},
    ManualReading{"mode", "1 and 2 do the same", wiki},
    ManualReading{
        "idcard",
        "over TCP units 0 and 255 reach it too; another one, and all while it is closed or a master, has "
        "the exception 11",
        wiki},
    ManualReading{"SEND", "no slave is connected: err and st_sended are 1 a second later", wiki},
    ManualReading{"st_msgrx", "any write into iword or ilong sets it while the device is an open slave",
                  wiki},
    ManualReading{
        "iword",
        "functions 5, 6, 15, 16, 22 and 23 write it: register NN has the address NN - 1; coil 1 is bit 0 "
        "of iword1, coil 17 that of iword2",
        wiki},
    ManualReading{"oword", "functions 1 to 4 all read it, by the same addresses", wiki},
    ManualReading{
        "olong",
        "the high word first, as Modbus sends a word's bytes: oword1 is the upper half of olong1; ilong "
        "alike",
        wiki},
    ManualReading{"wdata", "a value in its range resets it", wiki},
    ManualReading{"wcmd", "a command that is executed resets it", wiki},
};

}  // namespace drycut::devices::modbus::table

namespace drycut::devices::modbus {

inline constexpr DeviceType modbus_type{"MODBUS",
                                        "data exchange with a master or slaves over Modbus",
                                        table::variables,
                                        table::states,
                                        table::commands,
                                        table::fields,
                                        {},
                                        table::readings};

}  // namespace drycut::devices::modbus

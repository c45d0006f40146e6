// Bytes of a Modbus connection to an LX3VP, in pieces as they may come.
#include "devices/lx3vp/lx3vp_controller.hpp"
#include "sim/live/modbus/face_data.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace drycut {

DRYCUT_FUZZ(text) {
  namespace lx3vp = devices::lx3vp;
  namespace modbus = sim::live::modbus;
  Problems problems;
  lx3vp::Lx3vpController controller(lx3vp::il::compile("LD M0\nOUT Y0\nEND\n", "f.il", problems), 1'000'000);
  std::int64_t now = 0;
  modbus::FaceData data(*std::get<0>(controller.modbus()),
                        {[&](const std::string& name) { return controller.find(name); },
                         [&](const std::vector<std::pair<std::string, double>>& values) {
                           for (const auto& [name, number] : values)
                             if (controller.find(name)->misfit(number)) return false;
                           for (const auto& [name, number] : values) controller.find(name)->write(number);
                           return true;
                         },
                         [&] { return now; }});
  modbus::FrameReader reader;
  for (std::size_t at = 0; at < text.size() && !reader.broken();) {
    const std::size_t piece = 1 + static_cast<unsigned char>(text[at]) % 64;
    const auto part = text.substr(at, piece);
    reader.take({reinterpret_cast<const std::uint8_t*>(part.data()), part.size()});
    at += part.size();
    while (const auto frame = reader.next()) {
      const auto answer = modbus::answer(frame->pdu, data);
      if (answer.size() < 2 || answer.size() > 253) fuzz::broken("an answer is a PDU");
      const bool refused = answer[0] == (frame->pdu[0] | 0x80);
      if (answer[0] != frame->pdu[0] && !refused) fuzz::broken("an answer has the request's function");
      if (refused && (answer.size() != 2 || answer[1] < 1 || answer[1] > 3))
        fuzz::broken("an exception is 1, 2 or 3");
      modbus::FrameReader again;
      again.take(modbus::bytes_of({frame->transaction, frame->unit, answer}));
      const auto read = again.next();
      if (!read || read->pdu != answer || again.begun()) fuzz::broken("an answer is a frame");
    }
    controller.run_devices(now);
    controller.run_tasks(now);
    now += 1'000'000;
  }
}

}  // namespace drycut

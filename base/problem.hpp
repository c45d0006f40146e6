#pragma once
#include <algorithm>
#include <cstddef>
#include <drycut/problem.hpp>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace drycut {

/// A row of the table of codes. A code stands for a kind of slip or finding, not for a sentence.
struct CodeRow {
  std::string_view code;   ///< `room.kebab-word`; once released it stays, and is never used for another kind
  std::string_view text;   ///< what is the matter
  std::string_view cause;  ///< how one comes to it
  std::string_view cure;   ///< what to do
};

/// All codes, in the order of the alphabet.
// clang-format off
inline constexpr CodeRow code_rows[] = {
    {"bode.at-limit", "A reference stood at its limit of 10 V", "The sine is larger than the reference allows.", "Take less --amplitude."},
    {"bode.lost", "The answer to the sine is lost in what else moves", "The machine works while it is measured.", "Measure while the axis stands or runs evenly (--at), or take another --amplitude."},
    {"bode.no-answer", "The loop does not answer to the sine", "It is open there, or the axis sits in play or stiction.", "Choose another --at, let the program do REGON before, or see --limit-cycle."},
    {"bode.no-loop", "No position loop can be measured", "No analogue output of the controller is wired to a drive's reference.", "Wire one, such as 2.AN01: knife.servo.reference."},
    {"bode.no-margin", "No gain margin was found at any amplitude", "No answer could be trusted.", "Do what is said of the points, or take other frequencies."},
    {"bode.restless", "The loop does not come to rest after a push", "It is given too little time, or the push is too weak.", "Give more --settle or --amplitude."},
    {"bode.runaway", "The loop runs away after a push", "The directions of count and reference do not agree.", "Turn one of them round."},
    {"bode.unstable", "The loop swings on after a push", "Its gain is too high.", "Lower the gain."},
    {"cam.device", "The device refuses the cam, or warns of it", "A row breaks one of the device's own rules; its error number stands beside it.", "Change the row as the line says; the device's manual explains the number."},
    {"cam.half-turn", "The slave goes more than half a turn between two rows", "The device takes the shorter way, or the rows lack a turn.", "Write # endless: positive or negative, if the slave is to turn on."},
    {"cam.interpolation", "An interpolation that the table cannot have", "Its name or number is misspelt or of another kernel.", "Take one of those that the line lists."},
    {"cam.jump", "The slave's position, velocity or ratio jumps", "Two pieces of the cam do not meet with one slope.", "Put rows between, or take an interpolation without such jumps."},
    {"cam.leaves-range", "The slave leaves its range in the end", "Each cycle ends a little further than it began.", "Let the cam end where it began, or let it be endless."},
    {"cam.limit", "A velocity, acceleration, jerk or ratio is above its limit", "The cam asks for more than the axis may have.", "Run the master slower, or give the motion more way."},
    {"cam.manual-limits", "The cam passes a limit that the device's manual states", "The device says nothing, and may not do what is wanted.", "Keep to the manual's limit."},
    {"cam.missing", "A table lacks a line, a column or a value", "It is shorter than its header or its kind needs.", "Write what the line names."},
    {"cam.needs-another", "A setting means nothing without another one", "Only one of a pair is given.", "Give the other one too."},
    {"cam.no-ramp", "The slave starts or stops without a ramp", "The cam begins or ends at a velocity.", "Let it begin and end at rest."},
    {"cam.not-judged", "A part of the cam was not judged", "The run did not come there.", "Validate it with fewer jumps, or with other conditions."},
    {"cam.not-reached", "The cam does not reach the speed that it is given", "Its ramps take longer than there is time.", "Give the ramps less time."},
    {"cam.out-of-range", "A value of a cam table is out of its range", "It is more or less than the device takes.", "Take a value of the range that the line names."},
    {"cam.overshoot", "The slave overshoots its rows", "The interpolation swings between rows that lie unevenly.", "Put a row between, or take another interpolation."},
    {"cam.refused-by-device", "MC_CamIn would refuse the table", "It breaks a rule of the block; the line has the error's number.", "Change what the line names."},
    {"cam.remark", "Something worth knowing of the cam", "Nothing is wrong.", "None."},
    {"cam.resolution", "The slave's transducer is too fine for the master's", "The device's manual limits the ratio of their frequencies.", "Take a finer transducer on the master, or a coarser one on the slave."},
    {"cam.swapped-axes", "A cam is selected with master and slave the other way round", "MC_CamTableSelect and MC_CamIn do not name the same pair.", "Exchange them in one of the two."},
    {"cam.table-form", "A line of a cam table has the wrong form", "A colon is missing, or something stands where it does not belong.", "Write the line as the message shows."},
    {"cam.travel", "The slave leaves its travel", "The stroke is longer than the axis, or begins at the wrong place.", "Shorten the stroke, or move its beginning."},
    {"cam.turns-back", "The slave runs against its direction", "The curve between the rows falls where they rise.", "Bring the rows nearer to a steady rise, if it must not turn back."},
    {"cam.twice", "Something is given twice in a cam table", "Two lines say the same thing.", "Keep one of them."},
    {"cam.unknown-key", "A cam table has a setting, column, parameter or code that is not known", "It is misspelt, or of another device.", "Take the one that the line suggests, or one of its list."},
    {"cam.value", "A value of a cam table cannot be read", "It is no number, or of the wrong kind.", "Write it as the line shows."},
    {"check.alone-fails", "Nothing is amiss but one check", "Its limit, or its expression, may be the slip.", "Look at the check first, then at what it measures."},
    {"check.far-limit", "The limit of a check is a thousand times what came", "It may have the wrong unit.", "Correct the limit, or take the check for what it is."},
    {"check.first-fails", "Nothing tells why the checks failed; this one did first", "What went wrong shows in it before it shows in the others.", "Look at this check first, then at what it measures; drycut why --good compares with a run that is sound."},
    {"check.judged-nothing", "A check passed without judging anything", "Its condition was false at every instant or event.", "Correct the condition or the times of the check, or take the check out."},
    {"check.never-held", "A check held at no instant of the run", "Its expression looks at the wrong value, unit or limit.", "Compare it with what the line says that its names were."},
    {"cluster.not-there", "Nobody is there to run on", "The scheduler, the partition, the folder or Python's client is missing.", "Start it, name another, or run without --on."},
    {"cnf.declared-twice", "A name, slot or address of a configuration is declared twice", "Two lines give it.", "Rename one, or take one out."},
    {"cnf.same-counter", "Two names of a device stand for the same counter", "One address is given twice in the device's line.", "Give each its own address, if two were meant."},
    {"cnf.syntax", "A line of a configuration has the wrong form", "A field is missing, too much or out of place.", "Write the line as the message shows."},
    {"cnf.unknown-name", "A configuration names a section, type or device that is not known", "It is misspelt, or of another controller.", "Take the one that the line suggests."},
    {"cnf.value", "A number or an address of a configuration cannot be taken", "It is out of range, or no card has it.", "Take one of the range that the line names."},
    {"compare.runs", "There are no two runs to compare", "One alone is named, or the result would stand in one of them.", "Name two runs at least, and another folder for the result."},
    {"compare.tolerance", "A tolerance has the wrong form", "It is no number with its name and unit.", "Write NAME=VALUE, such as length=0.01mm."},
    {"compare.unknown-name", "The runs that are compared have nothing of this name", "It is misspelt, or one of them does not record it.", "Take a name that all runs record."},
    {"controller.axis-value", "A value of an axis cannot be taken", "It is out of range, no whole number, or in another unit.", "Write it as the line shows."},
    {"controller.bad-name", "A name that a program could not use", "It holds signs that no name or address has.", "Take letters, digits and underscores."},
    {"controller.bare-number", "A value without a unit stands beside values with units", "A bare number is in the kernel's own unit.", "Write the value with its unit."},
    {"controller.cam-kind", "A file is no kind of cam table that the controller takes", "Its ending says another kind.", "Give a table of the kernel (.tab) or a cam as CSV (.csv)."},
    {"controller.counts-lost", "A counter's card lost counts", "Its input filter does not follow the frequency of the encoder.", "Take a slower machine, fewer pulses or a faster card."},
    {"controller.pulses-lost", "A counter's card lost zero pulses", "They are shorter than the card's input filter needs.", "Take a slower machine, a wider pulse or a faster card."},
    {"controller.remark", "The controller remarked something during the run", "A command was refused, a value is out of range, a program waits or overran.", "Read the remark; events.csv has all of them."},
    {"controller.retained-twice", "A retained value is given twice", "Two lines of the file name it.", "Remove one of them."},
    {"controller.retained-value", "A line of a retentive file cannot be read", "It has no '=', or a value that the variable cannot hold.", "Write: name = value."},
    {"controller.slow-phasing", "An axis is synchronised very slowly", "v_phasing has the kernel's default.", "Give v_phasing, a_phasing, d_phasing and j_phasing."},
    {"controller.twice", "Two parts of the controller have one name or number", "Names are the same in any case.", "Rename one."},
    {"controller.unknown-kind", "A scenario names a controller that is not known", "It is misspelt.", "Take one of the list."},
    {"controller.unknown-name", "The controller has nothing of this name", "It is misspelt, or the program does not declare it.", "Name a variable of the program, or a value of an axis."},
    {"controller.unknown-retained", "A retentive file names what the program does not keep", "The program has changed since the file was written.", "Remove the line."},
    {"controller.value-overwritten", "A value that the scenario sets has no effect", "The program writes it first.", "Take the line out of the program, or let it write only where the value is 0."},
    {"controller.value-range", "A variable does not hold a value", "It is out of its range, or no whole number.", "Write a value of the range that the line names."},
    {"design.impossible", "No cam does the job within the limits", "A limit is too tight, or the ways a pulse are too coarse.", "Raise the limit that the line names, or change the job."},
    {"design.scene", "A cam cannot be put into the scene", "The scene plays no such cam, or is of another machine.", "Name a scene that plays one cam of the device."},
    {"drive.not-judged", "The heat of a drive is not judged", "The run shows no machine cycle.", "Give drives.cycle, or let the scene run longer."},
    {"drive.unsteady", "A drive has no steady cycle", "No cycle came to the same rms torque as the one before, or none did after the heaviest.", "Let the scene run for more cycles; the heaviest counts until then."},
    {"drive.warning", "A drive may be loaded more than was judged, or lost its mains", "Its heat was not judged, or no program knows of its mains.", "Let the scene run longer, or wire its mains_ok."},
    {"expression.arguments", "A function has too many or too few arguments", "An argument is missing or too much.", "Give as many as it takes."},
    {"expression.kind", "An expression is of the wrong kind", "A number stands where a condition is wanted, or it looks at nothing recorded.", "Compare it with a limit, or take the comparison out."},
    {"expression.not-here", "A function or name cannot stand here", "Statistics need a window, some figures stand in constraints only.", "Move it to where it means something."},
    {"expression.syntax", "An expression cannot be read", "An operator, a value or a bracket is missing or too much.", "Write it as the line shows."},
    {"expression.unit", "Units of an expression do not go together", "Quantities of different dimensions meet.", "Convert one of them."},
    {"expression.unknown-name", "An expression has a name or function that is not known", "It is misspelt, or nothing records it.", "Take the one that the line suggests."},
    {"faults.accepts-nothing", "An entry of accepted cells matches none", "The cell is no longer red, or its fault or moment has another name.", "Take the entry out."},
    {"faults.bad-entry", "An entry of accepted cells cannot be read", "It lacks a key, or has one that is not known.", "Write {fault: ..., when: ..., cell: ..., why: ...}."},
    {"faults.failed-before", "A check had failed before any fault", "The line does not make good product on its own.", "Make the scenario pass first."},
    {"faults.no-cycle", "A line has no machine cycle to spread moments over", "Nothing is cut, and drives.cycle is not named.", "Name drives.cycle, or let the scene run longer."},
    {"faults.no-product", "No check says what good product is", "None looks at each cut.", "Write one, or name checks under faults.product."},
    {"faults.not-tried", "A fault was not tried", "It needs a wire or a value that the line does not have.", "None: it is told for completeness."},
    {"faults.red", "A fault makes wrong product or damage and nobody is told", "Nothing in the program watches for it.", "Let the program watch, or accept the cell with a reason."},
    {"file.bad-name", "A file's or scene's name cannot be used for results", "Another one has it, or it is no name of a file.", "Give it another name."},
    {"file.in-use", "Another drycut is writing into the folder", "A run is still going on there.", "Let it end first, or name another folder."},
    {"file.missing", "There is no file of that name", "The path is misspelt, or seen from another folder.", "Check the path; it is relative to the file that names it."},
    {"file.not-ours", "There is something that drycut did not write", "It will not be overwritten.", "Name another folder or file, or move it away."},
    {"file.not-regular", "What is named is no regular file", "It is a folder or a device.", "Name a text file."},
    {"file.not-text", "A file is no text in UTF-8", "It has bytes or control characters that no text has.", "Save it as plain text in UTF-8."},
    {"file.not-writable", "A file or folder cannot be written", "It does not exist, is something else, or the rights are missing.", "Name one that can be written."},
    {"file.other-kind", "A file is of another kind than the command takes", "Its ending or its content says another one.", "Give the file to the command that the line names."},
    {"file.too-large", "A file is too large", "It is no text of a program or scenario.", "Name the right file."},
    {"file.unreadable", "A file cannot be read", "The rights are missing.", "Check its permissions."},
    {"il.coil-twice", "A coil is written in two places", "It has two OUT, or OUT and SET: the last one wins.", "Write it in one place."},
    {"il.index-register", "An index register is used where it cannot stand", "There is none of this number, or the operand takes none.", "Index a device, bits or a number: D10Z0."},
    {"il.jump", "A label or jump leads nowhere good", "The label is missing or there twice, or a jump leads into something.", "Give each label once, at a line that may be jumped to."},
    {"il.no-such-cam-type", "ECAMTBX is given a type of cam that it does not have", "K0, K1, K100 and K101 are known.", "Write one of these."},
    {"il.not-simulated", "An instruction or device of the PLC is not simulated", "Drycut has only what drycut devices LX3VP lists.", "Write it with instructions that are simulated."},
    {"il.operand", "An operand does not fit its instruction", "It is of another kind, or there are too many or few.", "Give what the line names."},
    {"il.out-of-range", "An operand goes beyond the devices that there are", "Its number is too high, or its block too long.", "Take one of the range that the line names."},
    {"il.rung", "A rung is not whole", "Contacts lead to no coil, or blocks and branches are not joined.", "Join them as the line shows."},
    {"il.structure", "A loop, sequence, master contact or subroutine is not whole", "One of a pair is missing, or they overlap.", "End what was begun, in the order in which it began."},
    {"il.syntax", "A line of an instruction list cannot be read", "A bracket or END is missing, or words stand where none belong.", "Write one instruction a line: LD X0."},
    {"il.unknown-instruction", "There is no such instruction", "It is misspelt, or of another PLC.", "Take the one that the line suggests."},
    {"il.width", "An operand is too wide for its instruction", "A 32-bit value stands in a 16-bit instruction.", "Use the 32-bit instruction, or a smaller value."},
    {"live.busy", "The live line has too much to do", "A client asks faster than the line answers.", "Wait for answers before asking more."},
    {"live.cannot-extend", "No scenario can be made of the session", "It ran with values or kept values that the scenario would not have.", "Do as the line says."},
    {"live.cannot-listen", "The address or port of a server cannot be used", "Another program listens there, or the address is not this machine's.", "Give another port, or 0 for any free one."},
    {"live.gateway-missing", "The OPC UA gateway cannot run", "Node.js or its packages are missing.", "Install them: make opcua."},
    {"live.message", "A message of the live line's protocol is wrong", "A key is missing, or of another type.", "Write it as the line shows; docs/reference/live_protocol.md has all."},
    {"live.no-modbus", "The controller has no Modbus", "It is of a kind without it.", "Leave --modbus out."},
    {"live.other-files", "A recorded session is played with files that have changed", "The scenario or one of its files is not the one of the recording.", "Take the files of the recording, or expect another run."},
    {"live.session-form", "A line of a session cannot be read", "The file is cut short or was edited.", "Take a file that drycut live --record wrote."},
    {"loop.axis-astray", "An axis moves away from where it is driven to", "Its counter counts the wrong way round, or forward and backward are swapped.", "Turn the count round, or swap the two wires."},
    {"loop.axis-hunts", "An axis swings to and fro, and the swings do not die away", "Its gain is too high for the machine.", "Lower its gain; drycut bode shows how far."},
    {"loop.axis-open", "No program closes the position loop of an axis", "LOOPON is never given.", "Give LOOPON for the axis."},
    {"loop.axis-stands", "An axis stands though its reference is not zero", "The drive has an offset or a dead band, and the position loop stands against it.", "Balance the offset, in the drive or by the device's offset."},
    {"loop.blow", "A machine ran into its stop, tore or sank", "Something before it went wrong.", "Look at what came before it in events.csv."},
    {"loop.counted-nothing", "A wired counter counted nothing", "Nothing turned the encoder, or it is the wrong one.", "Look at the wiring and at what should turn it."},
    {"loop.cycle-no-piece", "No whole number of a cam's cycles makes a piece", "The cam is of another length than a check wants.", "Make the cam for this length, or correct the check."},
    {"loop.error", "A controller or a machine reported an error", "The event says it.", "Look at the event and what came before it in events.csv."},
    {"loop.fault-put-in", "The timeline put in a fault before the failure", "The scenario wants it.", "None, if it was meant to be seen."},
    {"loop.lamp-stays-on", "A lamp of the panel stays on", "The program reports something by it.", "Look at what the lamp means in the program."},
    {"loop.machine-stands", "The machine has stopped working", "The program waits for something.", "Look at what it waits for."},
    {"loop.never-on", "Switches of the machine were never on, or outputs that move it", "The machine never came there, or the wire is another one.", "Look at the wiring and the way of the machine."},
    {"loop.not-pressed", "Nothing pressed a switch of the panel", "The timeline does not set it, or its `when` never came true.", "Let the timeline press it."},
    {"loop.odd-parameter", "A parameter with which hardly an axis works well", "It was mistyped, or never tuned.", "Look at it; drycut tune finds one."},
    {"loop.other-place", "An axis stands elsewhere than it believes", "No program homes it, and it begins at another place.", "Home it, or begin with the machine where the axis believes to be."},
    {"loop.other-scale", "An axis counts another way than its machine goes", "Its counts a unit differ from those of the encoder.", "Correct measure and pulse of the axis, or the encoder."},
    {"loop.other-zero", "A homed axis has another zero than its machine", "The home switch or the preset stands at another place.", "Correct the preset, if both should be the same."},
    {"loop.program-ended", "A program came to its end", "Nothing leads back to its beginning.", "Let it loop, if it has more to do."},
    {"loop.program-ended-early", "A program ended as it began, though it is to look after something", "Nothing leads back to its beginning.", "Let it loop."},
    {"loop.program-waits", "A program stands at a line", "It waits for something that does not come.", "Look at what the line waits for."},
    {"loop.rarely-sampled", "An axis is sampled too rarely", "Its sampling time or the controller's cycle has the wrong unit or number.", "Take 1 to 10 ms."},
    {"loop.search-met-stop", "A search for a switch ran into an end stop", "It went the other way, or the switch is not where it should be.", "Turn the search round, or move the switch."},
    {"loop.state-stands", "A state of the program has not changed for long", "What would change it does not come.", "Look at what the program waits for in this state."},
    {"loop.switched-on", "The line of the program that switched an output on", "The machine was not ready for it.", "Look at what the line waits for."},
    {"loop.timeline-set", "The timeline changed the machine before the failure", "The scenario wants it.", "None, if it was meant to be seen."},
    {"loop.torque-limit", "A drive was at its torque limit before the failure", "The motion asks for more torque than it has.", "Take a slower motion, less inertia or a larger drive; see drycut size."},
    {"loop.value-cut", "A program could not keep a value whole", "Its variable is too small for it.", "Take a larger variable, or a smaller value."},
    {"loop.value-out-of-range", "A value is outside of what the manual allows", "The device takes it all the same, and may not do what is wanted.", "Keep to the range that the line names."},
    {"loop.warning", "A controller or a machine warned before the failure", "The event says it.", "Look at the event in events.csv."},
    {"mesh.no-file", "There is no such mesh file", "The path is misspelt.", "Name a mesh file relative to the scenario."},
    {"mesh.scale", "A mesh is too small or too large for a part", "It is in another unit.", "Set scale."},
    {"mesh.too-large", "A mesh has too many bytes or triangles", "It was exported too finely.", "Export it with a coarser tolerance."},
    {"mesh.unknown-kind", "A mesh file is of a kind that is not known", "Its ending says another one.", "Export STL, OBJ, PLY, OFF, glTF, GLB or DAE."},
    {"mesh.unreadable", "A mesh cannot be read", "It is damaged, or holds no triangles.", "Export the part again."},
    {"option.does-not-apply", "An option means nothing here", "It belongs to another kind of question.", "Leave it out, or give what it needs."},
    {"option.file-name", "An option names a file that cannot be its own", "It is that of another option, or of another kind.", "Name another file."},
    {"option.missing", "Something that the command needs is not given", "An option or file is left out.", "Give what the line names."},
    {"option.out-of-range", "The value of an option is out of its range", "It is too large or too small.", "Give one of the range that the line names."},
    {"option.set-path", "A path of --set leads nowhere, or is none", "The scenario has no such key there.", "Write path=value with a path of the scenario."},
    {"option.together", "Two options do not go together", "They ask for different things.", "Leave one of them out."},
    {"option.unknown", "There is no such option", "It is misspelt, or of another command.", "Take the one that the line suggests; --help lists all."},
    {"option.unknown-choice", "An option has none of its choices", "It is misspelt.", "Take one of the list."},
    {"option.value", "The value of an option cannot be read", "It is no number, or has another form.", "Write it as the line shows."},
    {"pictures.event-missing", "There are no frames around an event", "It did not happen as often as `around` asks for.", "Ask for one that happens."},
    {"pictures.strobe", "A turning part looks slower, backwards or still in the film", "It turns by more than half a pitch from frame to frame.", "Take frames more often."},
    {"plant.motor-incomplete", "A motor of a catalogue lacks values", "Its sheet says more than was written.", "Write them from the sheet; drycut plants --motor-template shows which."},
    {"plant.motor-renamed", "A motor is called by an old name", "The catalogue has renamed it.", "Take the new name; the next release does not know the old one."},
    {"plant.motor-sheet", "A value of a catalogue does not go with its sheet", "It has no source, contradicts another one, or its name is none.", "Write what the sheet says, and where."},
    {"plant.motor-twice", "Two motors of a catalogue have one name", "They stand in one or two files.", "Rename one."},
    {"plant.motor-unchecked", "The values of a motor are not checked", "They were taken from an estimate or another motor.", "Compare them with its data sheet."},
    {"plant.no-room", "Two machines stand in one place", "One needs the room of the other.", "Give one a place further down the line."},
    {"plant.parameters-contradict", "Parameters of a plant contradict each other", "Together they describe no machine that there can be.", "Change one of them as the line says."},
    {"plant.reference-circle", "Plants refer to themselves in a circle", "Each needs another one first.", "Let one of them stand alone."},
    {"plant.step-too-long", "A part of the plant is too fast for the step", "A stiff spring, a strong damper or a small mass.", "Take a shorter scene.step, or a softer, heavier part."},
    {"plant.unknown-motor", "There is no motor of this name", "It is misspelt, or of another catalogue.", "drycut plants --motors lists them."},
    {"plant.unknown-plant", "There is no plant of this name", "It is misspelt, or not in the scenario.", "Take the one that the line suggests."},
    {"plant.unknown-type", "There is no such type of plant", "It is misspelt.", "Take the one that the line suggests; drycut plants lists them."},
    {"plant.wrong-reference", "A plant refers to one of another type", "A knife needs a web, and the like.", "Name a plant of the type that the line names."},
    {"program.block-elsewhere", "A DECAM works on another block than ECAMTBX makes", "The two name different registers.", "Let both name one block."},
    {"program.never-called", "Nothing calls a function block", "Its call is missing.", "Call it, or take it out."},
    {"program.never-set", "A variable is read, and nothing sets it", "Its assignment is missing, or its name is misspelt.", "Set it, or take it out."},
    {"program.never-started", "A timer is asked, and no task starts it", "Its assignment is missing.", "Start it: tmPause = 100."},
    {"program.set-twice", "A value is set twice, one behind the other", "The first of two statements does nothing.", "Take one out, or correct the name of one."},
    {"qcl.block", "A block of a program is not whole", "Its beginning or its end is missing, or blocks overlap.", "Write what is missing."},
    {"qcl.does-not-fit", "A number does not fit the size of its variable", "It is outside of what the size holds, and is cut.", "Take a number that fits, or a larger size."},
    {"qcl.no-configuration", "A QCL module needs its configuration", "It names what only the .cnf declares.", "Name the .cnf file before it."},
    {"qcl.not-writable", "A program writes what it must not", "It is a state, a constant or a name of another kind.", "Assign a variable or a parameter that may be written."},
    {"qcl.out-of-range", "A number or index is out of range", "It is larger than the type or the array.", "Take one of the range."},
    {"qcl.outside-range", "A number is outside of the range of what it is written to", "The device takes it and may refuse it later.", "Take a number of the range."},
    {"qcl.rounded", "A number with a fraction is written to a whole variable", "The device takes whole numbers.", "Write a whole number."},
    {"qcl.syntax", "A statement cannot be read", "A sign or word is missing, or too much stands there.", "Write it as the line shows: one statement a line."},
    {"qcl.twice", "A label, subroutine or ELSE stands twice", "Two lines give it.", "Rename or remove one."},
    {"qcl.type", "A value is of another kind than its place takes", "A single stands where a whole number is wanted, and the like.", "Give what the line names."},
    {"qcl.unknown-name", "A program names what is not declared", "It is misspelt, or missing in the configuration.", "Declare it, or take the one that the line suggests."},
    {"record.channel-name", "HDF5 can have no channel of this name", "It has a sign that HDF5 keeps for itself.", "Rename it, or convert to another format."},
    {"record.damaged", "A recording is damaged", "The file is cut short or was edited.", "Run the scenario again."},
    {"record.no-run", "There is no run here", "The folder is none that drycut run made, or it is not whole.", "Name a folder that drycut run made, or run the scenario again."},
    {"record.not-a-record", "The file is no recording", "It is of another program.", "Name a file that drycut wrote."},
    {"registers.twice", "A register is given twice", "Two lines name it.", "Keep one of them."},
    {"registers.unknown-register", "There is no such register, or it is not simulated", "It is misspelt, or beyond the PLC's.", "Take one of those that the line names."},
    {"registers.value", "A value of a register cannot be taken", "It is no number, or the register takes none.", "Write 5, -5, K5, H1F or 1.5."},
    {"run.failed", "A run or a command could not go on", "A file could not be written, memory or a worker failed, or the motion diverged.", "Mend what the line names, and start again."},
    {"run.left-out", "Something of the results could not be made", "A file could not be written or read; the rest is there.", "Mend what the line names, and run again."},
    {"run.not-cached", "A run is not kept in the cache", "The cache cannot be written.", "Look at the folder of the cache, or take another."},
    {"scenario.bad-name", "A name cannot be used here", "It holds signs that a name must not have.", "Take letters, digits and underscores."},
    {"scenario.does-not-go-together", "Two things of a scenario exclude each other", "Both are given, or one stands where it means nothing.", "Keep one of them."},
    {"scenario.extends-itself", "A scenario extends itself", "Its parents lead back to it.", "Let one of them extend nothing."},
    {"scenario.missing-key", "A key that is needed is missing", "A section is not whole.", "Give it."},
    {"scenario.needs-another", "Something is of no use without another thing", "Only one of a pair is given.", "Give the other one, or leave this out."},
    {"scenario.no-value", "A key has no value", "Nothing stands behind its colon.", "Give it one, or leave the key out."},
    {"scenario.not-a-number", "A number is wanted", "There is a text, a decimal comma or a fraction.", "Write a number, with its unit if it has one."},
    {"scenario.not-a-scenario", "A file is no scenario, or empty", "It has none of a scenario's sections.", "Name a scenario with sections."},
    {"scenario.order", "Two times or limits stand in the wrong order", "The end comes before the beginning.", "Let the later one be later."},
    {"scenario.out-of-range", "A value is out of its range", "It is larger or smaller than makes sense.", "Take one of the range that the line names."},
    {"scenario.time-grid", "A time does not fit the steps", "It is no whole multiple of scene.step, or shorter than it.", "Take one of the times that the line names, or a step that divides it."},
    {"scenario.twice", "Something is given twice", "Two lines have the same key or name.", "Keep one of them."},
    {"scenario.unknown-choice", "A word is none of its choices", "It is misspelt.", "Take one of the list."},
    {"scenario.unknown-event", "There is no such event, or it has no such value", "It is misspelt, or no plant reports it.", "drycut plants lists the events of a plant."},
    {"scenario.unknown-key", "A section has no such key", "It is misspelt, or stands in the wrong section.", "Take the one that the line suggests."},
    {"scenario.unknown-name", "There is nothing of this name in the scene", "It is misspelt, or left out.", "Take the one that the line suggests."},
    {"scenario.unknown-unit", "A unit is not known", "It is misspelt, or in capitals.", "Take the one that the line suggests."},
    {"scenario.unknown-variable", "There is no such variable, or it is not used", "Its name is misspelt.", "Declare it under variables, or take the one that the line suggests."},
    {"scenario.unused-variable", "A variable is not used", "Nothing names it as ${...}, or a name is misspelt.", "Use it or take it out."},
    {"scenario.variable-circle", "A variable needs itself, or grows without end", "Its value leads back to it.", "Give one of them a value of its own."},
    {"scenario.variable-syntax", "A variable is written wrongly", "The name alone stands in ${ }.", "Write ${name}, with arithmetic around it."},
    {"scenario.variable-value", "The value of a variable does not fit where it is used", "It is of another dimension, or no plain number.", "Change the value, or convert it."},
    {"scenario.wrong-kind", "A value is of the wrong kind", "A list stands where a map is wanted, and the like.", "Write it as the line shows."},
    {"scenario.wrong-unit", "A quantity has the wrong unit or none", "It is of another dimension.", "Give it in the unit that the line names."},
    {"scenario.yaml-not-taken", "A scenario uses a part of YAML that is not taken", "Anchors, aliases, tags, deep nesting or a second document.", "Write the value out."},
    {"scenario.yaml-syntax", "A text is not readable as YAML", "Indentation, a colon, a quote or a bracket is wrong.", "Look at this line and the one before it."},
    {"size.gear-unchanged", "Stiffness, play and friction are the same behind every gear", "They are those of the scenario.", "Give a gear of another ratio a scenario of its own."},
    {"size.gear-unfit", "A gear cannot be tried as the machine is", "The encoder would count no whole number of lines behind it.", "Take another gear, or other lines."},
    {"size.inertia-limit", "What limits the ratio of load and rotor inertia", "The maker's value, or a usual one where the catalogue has none, rules out motors.", "--inertia-ratio sets another limit, off none."},
    {"st.call", "A call does not fit what is called", "An input or output is missing, unknown or of the wrong direction.", "Call it as the line shows."},
    {"st.configuration", "A CONFIGURATION is not whole", "A task, resource or program lacks something.", "Write it as the line shows."},
    {"st.declaration", "A variable cannot be declared so", "Its type or its section does not allow it.", "Declare it as the line shows."},
    {"st.declared-twice", "A name or place is given twice", "Two lines declare it.", "Rename one, or take one out."},
    {"st.division-by-zero", "A division by 0", "The divisor is the constant 0, or became 0.", "Test the divisor before."},
    {"st.initial-value", "An initial value cannot be taken", "It is not constant, or the variable takes none.", "Give a literal or a VAR CONSTANT, or none."},
    {"st.literal", "A literal cannot be read", "It has a wrong digit, base or part.", "Write it as the line shows."},
    {"st.loop", "A loop is of no use", "It counts nothing, never ends, or EXIT stands in none.", "Change it as the line says."},
    {"st.no-result", "An operation has no finite result", "A function is given what it does not take.", "Test the value before."},
    {"st.out-of-range", "A number, index or text does not fit", "It is larger than its type, range or length.", "Take a value of the range that the line names."},
    {"st.place", "A variable cannot be at this place", "The address is none, or of another width.", "Take an address that fits its type."},
    {"st.pragma", "A pragma cannot be read", "A condition is not known, or {IF} and {END_IF} do not match.", "Write it as the line shows."},
    {"st.recursion", "Something calls or contains itself", "IEC 61131-3 has no recursion.", "Use a loop."},
    {"st.syntax", "A statement cannot be read", "A sign or word is missing, or too much stands there.", "Write it as the line shows."},
    {"st.too-large", "A program, type or expression is too large", "It is nested too deeply, or takes too much memory.", "Split it up."},
    {"st.type", "A value is of the wrong type", "Types are not converted by themselves here.", "Convert it: X_TO_Y(...)."},
    {"st.unknown-name", "A name is not declared", "It is misspelt, or its declaration is missing.", "Declare it, or take the one that the line suggests."},
    {"st.use", "Something is used as what it is not", "A function block is called like a function, a variable has no members, and the like.", "Use it as the line shows."},
    {"state.damaged", "A kept state cannot be used", "It was cut short or changed, or the disk was full.", "None: the one before it is taken."},
    {"state.lost", "No more moments of the run are kept", "The disk is full, or the folder cannot be written.", "Make room; the run itself goes on."},
    {"state.none", "A run keeps no state to go on from", "It was run without --states, or was stopped before the first one.", "Run it with --states \"1 s\"."},
    {"state.refused", "A state goes with another scenario, program or drycut", "Something of it has changed since.", "Run from zero, or with what it was kept with."},
    {"state.went-on", "A run did not begin at zero", "It went on from a kept state.", "None."},
    {"study.argument", "A question of a study cannot be read", "A range, list or term has the wrong form.", "Write it as the line shows."},
    {"study.out-of-range", "A study asks for too much or too little", "Points, runs or values are beyond what it takes.", "Take a number of the range that the line names."},
    {"study.twice", "Something is given twice to a study", "Two options say the same thing.", "Keep one of them."},
    {"study.unknown-name", "A study names what its scenario has not", "It is misspelt, or of another scenario.", "Take the one that the line suggests."},
    {"study.wrong-unit", "A value of a study has the wrong unit or none", "It is of another dimension than the path.", "Give it in the unit that the line names."},
    {"text.number-out-of-range", "A number of a program is too large", "Its type ends before.", "Take one of the range that the line names."},
    {"text.too-many-problems", "There are too many problems to tell all", "The file is probably of another kind.", "Mend the first ones, or name the right file."},
    {"text.unexpected-character", "A character that the language does not have", "It was typed by mistake, or pasted.", "Take it away."},
    {"timeline.fixed", "A parameter cannot change while the machine runs", "It is built in when the run begins.", "Give it under plants."},
    {"timeline.never-happened", "An entry of the timeline never acted", "Its `when` never came true, or it is due behind the end.", "Correct its time or condition, or let the scene run longer."},
    {"timeline.no-such-fault", "A component does not offer this fault", "It is misspelt, or of another component.", "drycut plants lists the faults."},
    {"timeline.nothing-to-set", "There is nothing of this name to set or disturb", "It is misspelt, or can only be read.", "Take the one that the line suggests."},
    {"why.budget", "The least difference was not reached within the budget", "There are many differences, or a run fails in other ways.", "Give more --budget."},
    {"why.cause", "What turns a good run into a failed one", "Without it the check holds.", "Take it back, or change it."},
    {"why.no-difference", "Two runs do not differ in what they are made of", "They are of one scenario, with the same programs.", "Name a run or scenario that passes."},
    {"why.not-good", "What should be good fails, too", "It fails the same check, or another one.", "Name a run or scenario that passes."},
    {"why.not-tried", "A difference could not be tried alone", "The mixed scenario or program is refused.", "None: it is told for completeness."},
    {"why.passed", "A run that passed has no cause of failure", "All its checks held.", "Name the folder of a run that failed."},
    {"why.return", "Until when taking the difference away still saves the run", "From then on it is lost.", "None."},
    {"why.sign", "The first sign of a failure", "It came before the check failed.", "Look there first."},
    {"wiring.always-enabled", "A drive is on always, whatever its axis does", "The terminal that switches it is not wired.", "Wire the axis's enable to the drive's."},
    {"wiring.cam-contradicts", "A cam and a machine have different circumferences", "The cam's slope in its synchronous part does not fit the drum.", "Make the cam for this drum."},
    {"wiring.counts-contradict", "An axis and its encoder have different counts", "Its path parameters do not fit the encoder and its gear.", "Correct one of them."},
    {"wiring.crossed", "Two wires seem to be crossed", "Each terminal has the name of the other's plug in the program.", "Exchange the two wires, or the names."},
    {"wiring.fault-of-nothing", "A fault is put in where nothing is wired", "It acts at another component than the one that the controller reads.", "Name the component that is wired, or take the fault out."},
    {"wiring.idle-output", "A wired output is worked by no program", "The program names another, or the wire is at the wrong one.", "Move the wire or let the program work it."},
    {"wiring.kinds-differ", "A terminal and a plug are of different kinds", "A pulse train meets a level, an input an output, and the like.", "Wire it to one of those that the line names."},
    {"wiring.master-backwards", "An axis counts its master down as it runs forward", "The direction of count of the master is the other one.", "Turn the direction of count round."},
    {"wiring.no-plug", "There is no such plug", "The plant or its plug is misspelt.", "Take one of those that the line names."},
    {"wiring.no-terminal", "The controller has no such terminal", "It is misspelt, or the configuration does not use it.", "Take one of those that the line names."},
    {"wiring.no-zero-pulse", "Nothing is wired to a zero pulse that a search needs", "prsmode 1 waits for it.", "Wire the encoder's index, or take another prsmode."},
    {"wiring.nothing-to-filter", "A filter stands at a terminal without a signal", "Nothing is wired to it.", "Wire it, or leave the filter out."},
    {"wiring.open-terminal", "The program works or reads a terminal that nothing is wired to", "A wire is missing, or the program names the wrong one.", "Wire it, or name the right one."},
    {"wiring.other-zero-pulse", "An axis takes its zero pulse from another encoder than it counts", "Two wires are mixed up.", "Wire the index of the encoder that it counts."},
    {"wiring.shared-counter", "Two counters are wired to one encoder", "One of the wires may be wrong.", "Move one of them, if two encoders were meant."},
    {"wiring.speed-contradicts", "The parameters of an axis and its machine give different speeds at 10 V", "maxvel, unitvel, decpt and counts a unit do not fit drive and encoder.", "Correct the parameters or the drive's speed at 10 V."},
    {"wiring.strange-unit", "The counts of an axis make a unit of no round length", "Lines, wheel or gear of its parameters do not fit the machine.", "Correct the counts and the way of a unit."},
    {"wiring.twice", "A terminal or plug is wired twice", "A terminal takes one wire, a plug has one driver.", "Remove one of the wires."},
    {"wiring.units-differ", "An axis and its master have different units", "Their counts a unit do not fit each other.", "Give both the same unit."},
    {"wiring.unread-counter", "A wired counter is not named by the program", "The program names another, or needs none.", "Move the wire, or let the program read it."},
    {"wiring.unused-terminal", "Terminals are not wired", "Nothing is amiss: no program needs them.", "None."},
};
// clang-format on

struct CodeTable {
  static_assert(std::is_sorted(std::begin(code_rows), std::end(code_rows),
                               [](const CodeRow& a, const CodeRow& b) { return a.code <= b.code; }),
                "codes stand in the order of the alphabet, each once");
  /// The row of a code; nullptr = it has none.
  static constexpr const CodeRow* find(std::string_view code) {
    const auto* row = std::lower_bound(std::begin(code_rows), std::end(code_rows), code,
                                       [](const CodeRow& a, std::string_view b) { return a.code < b; });
    return row != std::end(code_rows) && row->code == code ? row : nullptr;
  }
  /// A code that is read back; nothing = it has no row.
  static std::optional<Code> named(std::string_view code) {
    const auto* row = find(code);
    return row != nullptr ? std::optional(Code(row->code)) : std::nullopt;
  }
  /// A code as it is written in the source, N with the zero at its end.
  template <std::size_t N>
  struct Literal {
    char text[N];
    constexpr Literal(const char (&from)[N]) { std::copy_n(from, N, text); }  // NOLINT(google-explicit-constructor)
  };
  template <Literal literal>
  static constexpr Code code() {
    constexpr const CodeRow* row = find({literal.text, sizeof literal.text - 1});
    static_assert(row != nullptr, "a code that has no row in code_rows");
    return Code(row->code);
  }
};

/// "scenario.unknown-key"_code: what has no row does not compile. A template and not consteval, for clang 14 calls
/// consteval literals of a template as if they were there.
template <CodeTable::Literal literal>
constexpr Code operator""_code() {
  return CodeTable::code<literal>();
}

/// Where a text names a file.
struct NamedAt {
  std::string file;  ///< of the text
  int line = 1;
  int column = 1;
};

std::string to_string(const Problem& problem);
std::string to_string(const Finding& finding);

/// The candidate nearest to `word` (edit distance, case-insensitive), or "" if none is near enough to
/// suggest.
std::string nearest(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace drycut

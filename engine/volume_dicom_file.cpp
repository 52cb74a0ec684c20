// The one file that knows DCMTK. Nothing is thrown across the boundary, nothing is printed.
#include "engine/volume_dicom_file.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcistrmb.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmjpeg/djdecode.h>
#include <dcmtk/dcmjpls/djdecode.h>
#include <dcmtk/oflog/oflog.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <mutex>
#include <vector>

struct plr_dicom {
    DcmDataset set;
    std::vector<DcmItem *> frames; // the functional groups of each frame
    DcmItem *shared = nullptr;     // of all frames
    size_t next_frame = 0;         // the one that begins with this fragment
    Uint32 next_fragment = 0;
};

namespace {

// The library prints what it thinks of a file; the level of that is its host's alone to keep.
// Files may be read by several threads at once: the last one puts the level back.
class Silence {
  public:
    Silence() {
        std::lock_guard<std::mutex> lock(mutex);
        if (depth++)
            return;
        level = root().getLogLevel();
        root().setLogLevel(OFLogger::OFF_LOG_LEVEL);
    }
    ~Silence() {
        std::lock_guard<std::mutex> lock(mutex);
        if (--depth == 0)
            root().setLogLevel(level);
    }
    Silence(const Silence &) = delete;
    Silence &operator=(const Silence &) = delete;

  private:
    static dcmtk::log4cplus::Logger root() { return dcmtk::log4cplus::Logger::getRoot(); }
    static std::mutex mutex;
    static int depth;
    static dcmtk::log4cplus::LogLevel level;
};
std::mutex Silence::mutex;
int Silence::depth;
dcmtk::log4cplus::LogLevel Silence::level;

void register_decoders() {
    static std::once_flag once;
    std::call_once(once, [] {
        DJDecoderRegistration::registerCodecs(EDC_photometricInterpretation, EUC_default,
                                              EPC_colorByPixel);
        DJLSDecoderRegistration::registerCodecs();
    });
}

void set_fault(char *fault, const char *text) {
    std::snprintf(fault, PLR_DICOM_FAULT, "%s", text);
}

DcmTagKey key(uint32_t tag) {
    return DcmTagKey(static_cast<Uint16>(tag >> 16), static_cast<Uint16>(tag & 0xffff));
}

constexpr uint32_t SHARED_GROUPS = 0x52009229, FRAME_GROUPS = 0x52009230;

DcmSequenceOfItems *find_sequence(DcmItem &item, uint32_t tag) {
    DcmSequenceOfItems *sequence = nullptr;
    return item.findAndGetSequence(key(tag), sequence).good() ? sequence : nullptr;
}

void find_groups(plr_dicom &file) {
    DcmSequenceOfItems *shared = find_sequence(file.set, SHARED_GROUPS);
    if (shared && shared->card() > 0)
        file.shared = shared->getItem(0);
    DcmSequenceOfItems *frames = find_sequence(file.set, FRAME_GROUPS);
    DcmObject *item = nullptr;
    while (frames && (item = frames->nextInContainer(item)))
        file.frames.push_back(dynamic_cast<DcmItem *>(item));
}

DcmElement *find_element(DcmItem &item, uint32_t tag) {
    DcmElement *element = nullptr;
    return item.findAndGetElement(key(tag), element).good() ? element : nullptr;
}

DcmElement *find_in_group(DcmItem *groups, uint32_t group, uint32_t tag) {
    DcmSequenceOfItems *sequence = groups ? find_sequence(*groups, group) : nullptr;
    DcmItem *item = sequence && sequence->card() > 0 ? sequence->getItem(0) : nullptr;
    return item ? find_element(*item, tag) : nullptr;
}

DcmElement *find_of_frame(plr_dicom &file, size_t frame, uint32_t group, uint32_t tag) {
    DcmElement *found = nullptr;
    if (group && frame < file.frames.size())
        found = find_in_group(file.frames[frame], group, tag);
    if (group && !found)
        found = find_in_group(file.shared, group, tag);
    return found ? found : find_element(file.set, tag);
}

// DS, IS or binary numbers, whatever the language of the host. Stops at what is no number.
size_t parse_numbers(const OFString &text, double *numbers, size_t count) {
    const char *at = text.c_str(), *end = at + text.length();
    size_t found = 0;
    while (found < count) {
        while (at < end && (*at == ' ' || *at == '+'))
            at++;
        const auto result = std::from_chars(at, end, numbers[found]);
        if (result.ec != std::errc())
            break;
        found++;
        at = std::find(result.ptr, end, '\\');
        if (at++ == end)
            break;
    }
    return found;
}

OFCondition read_set(DcmDataset &set, const char *data, size_t length, const char *syntax) {
    const DcmXfer xfer(syntax);
    if (xfer.getXfer() == EXS_Unknown)
        return makeOFCondition(0, 1, OF_error, "its transfer syntax is not known");
    DcmInputBufferStream stream;
    stream.setBuffer(data, static_cast<offile_off_t>(length));
    stream.setEos();
    set.transferInit();
    OFCondition status = set.read(stream, xfer.getXfer(), EGL_noChange);
    set.transferEnd();
    return status;
}

OFCondition unpack_frame(plr_dicom &file, DcmElement &element, size_t frame, void *out, size_t size,
                         OFString &photometric) {
    Uint32 needed = 0;
    if (element.getUncompressedFrameSize(&file.set, needed).bad() ||
        (needed + 1) / 2 != (size + 1) / 2)
        return EC_CorruptedData;
    Uint32 fragment = frame == file.next_frame ? file.next_fragment : 0;
    OFCondition status =
        element.getUncompressedFrame(&file.set, static_cast<Uint32>(frame), fragment, out,
                                     static_cast<Uint32>(size + size % 2), photometric);
    if (status == EC_CannotChangeRepresentation || status == EC_UnsupportedEncoding)
        status = makeOFCondition(0, 2, OF_error, "its way of packing pixels is not read");
    file.next_frame = status.good() ? frame + 1 : 0;
    file.next_fragment = status.good() ? fragment : 0;
    return status;
}

} // namespace

bool plr_dicom_is_built(void) {
    return true;
}

plr_dicom *plr_dicom_open(const char *set, size_t length, const char *syntax,
                          char fault[PLR_DICOM_FAULT]) {
    plr_dicom *file = nullptr;
    try {
        Silence silence;
        register_decoders();
        file = new plr_dicom;
        OFCondition status = read_set(file->set, set, length, syntax);
        if (status.good()) {
            find_groups(*file);
            return file;
        }
        set_fault(fault, status.text());
    } catch (...) {
        set_fault(fault, "there is not enough memory");
    }
    plr_dicom_close(file);
    return nullptr;
}

void plr_dicom_close(plr_dicom *file) {
    try {
        Silence silence;
        delete file;
    } catch (...) {
    }
}

size_t plr_dicom_numbers(const plr_dicom *file, size_t frame, uint32_t group, uint32_t tag,
                         double *numbers, size_t count) {
    size_t found = 0;
    try {
        Silence silence;
        // finding moves cursors inside the library
        DcmElement *element = find_of_frame(const_cast<plr_dicom &>(*file), frame, group, tag);
        OFString text; // numbers with backslashes between them, also of binary elements
        if (element && element->getOFStringArray(text, OFFalse).good())
            found = parse_numbers(text, numbers, count);
    } catch (...) {
    }
    return found;
}

void plr_dicom_text(const plr_dicom *file, uint32_t tag, char *text, size_t size) {
    std::snprintf(text, size, "%s", "");
    try {
        Silence silence;
        OFString value;
        DcmElement *element = find_element(const_cast<plr_dicom &>(*file).set, tag);
        if (element && element->getOFString(value, 0, OFTrue).good())
            std::snprintf(text, size, "%s", value.c_str());
    } catch (...) {
    }
}

bool plr_dicom_has(const plr_dicom *file, uint32_t tag) {
    try {
        Silence silence;
        return find_element(const_cast<plr_dicom &>(*file).set, tag) != nullptr;
    } catch (...) {
        return false;
    }
}

bool plr_dicom_frame(plr_dicom *file, size_t frame, void *out, size_t size, char photometric[32],
                     char fault[PLR_DICOM_FAULT]) {
    try {
        Silence silence;
        OFString model;
        DcmElement *element = nullptr;
        OFCondition status = file->set.findAndGetElement(DCM_PixelData, element);
        if (status.good())
            status = unpack_frame(*file, *element, frame, out, size, model);
        std::snprintf(photometric, 32, "%s", model.c_str());
        if (status.bad())
            set_fault(fault, status.text());
        return status.good();
    } catch (...) {
        set_fault(fault, "its pixel data are damaged");
        return false;
    }
}

/* The one file that knows FFmpeg's libraries. Only the first frame of the first video is decoded,
 * from memory, by formats that never open other files. */
#include "engine/image_movie.h"

#include <stdlib.h>
#include <string.h>

#include "engine/image_internal.h"

static const struct {
    size_t offset;
    const char *magic;
    size_t length;
} magics[] = {
    {4, "ftyp", 4},
    {4, "moov", 4},
    {4, "mdat", 4},
    {4, "wide", 4},
    {0, "\x1a\x45\xdf\xa3", 4},
    {8, "AVI ", 4},
    {0, "OggS", 4},
    {0, "\0\0\1\xba", 4},
    {0, "\0\0\1\xb3", 4},
    {0, "FLV\1", 4},
    {0, "\x30\x26\xb2\x75", 4},
};

bool plr_movie_is(const char *data, size_t length) {
    for (size_t i = 0; i < sizeof magics / sizeof *magics; i++)
        if (length >= magics[i].offset + magics[i].length &&
            memcmp(data + magics[i].offset, magics[i].magic, magics[i].length) == 0)
            return true;
    return false;
}

#if !PLR_HAS_MOVIES

const char *plr_movie_decode(const char *data, size_t length, plr_image *image) {
    (void)data;
    (void)length;
    (void)image;
    return "it is a movie, and this plugray was built without FFmpeg's libraries";
}

#else

#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/imgutils.h>
#include <libavutil/pixdesc.h>
#include <libswscale/swscale.h>

enum {
    BUFFER_BYTES = 1 << 16,
    MAX_PACKETS = 4096 /* before the first frame comes out */
};

typedef struct input {
    const char *data;
    size_t length, at;
} input;

typedef struct movie {
    AVFormatContext *format;
    AVIOContext *io;
    AVCodecContext *codec;
    AVPacket *packet;
    AVFrame *frame;
    int stream;
} movie;

static int read_packet(void *user, uint8_t *buffer, int size) {
    input *in = user;
    size_t left = in->length - in->at, count = (size_t)size < left ? (size_t)size : left;
    if (count == 0)
        return AVERROR_EOF;
    memcpy(buffer, in->data + in->at, count);
    in->at += count;
    return (int)count;
}

static int64_t seek(void *user, int64_t offset, int whence) {
    input *in = user;
    int64_t length = (int64_t)in->length, from = 0;
    whence &= ~AVSEEK_FORCE;
    if (whence == AVSEEK_SIZE)
        return length;
    if (whence == SEEK_CUR)
        from = (int64_t)in->at;
    else if (whence == SEEK_END)
        from = length;
    if (offset < -from || offset > length - from)
        return -1;
    in->at = (size_t)(from + offset);
    return (int64_t)in->at;
}

static bool open_format(movie *m, input *in) {
    unsigned char *buffer = av_malloc(BUFFER_BYTES);
    m->format = avformat_alloc_context();
    m->io =
        buffer ? avio_alloc_context(buffer, BUFFER_BYTES, 0, in, read_packet, NULL, seek) : NULL;
    if (!m->format || !m->io) {
        if (!m->io)
            av_free(buffer);
        return false;
    }
    m->format->pb = m->io;
    AVDictionary *options = NULL;
    av_dict_set(&options, "format_whitelist",
                "mov,mp4,m4a,3gp,3g2,mj2,matroska,webm,avi,ogg,mpeg,mpegvideo,flv,asf", 0);
    av_dict_set(&options, "protocol_whitelist", "none", 0);
    av_dict_set(&options, "max_streams", "64", 0);
    av_dict_set(&options, "probesize", "1000000", 0);
    av_dict_set(&options, "analyzeduration", "1000000", 0);
    int opened = avformat_open_input(&m->format, NULL, NULL, &options);
    av_dict_free(&options);
    return opened >= 0;
}

/* One thread, so that the picture is the same each time. */
static bool open_codec(movie *m) {
    const AVCodec *decoder = NULL;
    if (avformat_find_stream_info(m->format, NULL) < 0)
        return false;
    m->stream = av_find_best_stream(m->format, AVMEDIA_TYPE_VIDEO, -1, -1, &decoder, 0);
    if (m->stream < 0 || !decoder)
        return false;
    m->codec = avcodec_alloc_context3(decoder);
    if (!m->codec ||
        avcodec_parameters_to_context(m->codec, m->format->streams[m->stream]->codecpar) < 0)
        return false;
    m->codec->thread_count = 1;
    m->codec->max_pixels = PLR_IMAGE_MAX_BYTES / 4;
    return avcodec_open2(m->codec, decoder, NULL) >= 0;
}

static bool decode_frame(movie *m) {
    m->packet = av_packet_alloc();
    m->frame = av_frame_alloc();
    bool ended = false;
    for (int i = 0; m->packet && m->frame && i < MAX_PACKETS; i++) {
        int got = avcodec_receive_frame(m->codec, m->frame);
        if (got >= 0)
            return true;
        if (got != AVERROR(EAGAIN) || ended)
            return false;
        ended = av_read_frame(m->format, m->packet) < 0;
        if (ended)
            avcodec_send_packet(m->codec, NULL);
        else if (m->packet->stream_index == m->stream)
            avcodec_send_packet(m->codec, m->packet); /* a damaged one is left out */
        av_packet_unref(m->packet);
    }
    return false;
}

/* What a file does not say is BT.709 for high pictures, else BT.601. */
static void set_matrix(struct SwsContext *scaler, const AVFrame *frame) {
    int matrix = frame->colorspace != AVCOL_SPC_UNSPECIFIED && frame->colorspace != AVCOL_SPC_RGB
                     ? (int)frame->colorspace
                 : frame->height >= 720 ? SWS_CS_ITU709
                                        : SWS_CS_ITU601;
    bool full = frame->color_range == AVCOL_RANGE_JPEG;
    sws_setColorspaceDetails(scaler, sws_getCoefficients(matrix), full,
                             sws_getCoefficients(SWS_CS_DEFAULT), 1, 0, 1 << 16, 1 << 16);
}

static const char *convert_frame(const AVFrame *frame, plr_image *image) {
    const AVPixFmtDescriptor *format = av_pix_fmt_desc_get((enum AVPixelFormat)frame->format);
    if (!format || frame->width < 1 || frame->height < 1)
        return "its first frame has no pixels";
    bool alpha = format->flags & AV_PIX_FMT_FLAG_ALPHA;
    int components = alpha ? 4 : 3;
    if (frame->width > (int)PLR_IMAGE_MAX_SIDE || frame->height > (int)PLR_IMAGE_MAX_SIDE ||
        (size_t)frame->width * (size_t)frame->height > PLR_IMAGE_MAX_BYTES / 4)
        return "it is too large";
    /* some of the library's loops write whole vectors: rows are padded, then packed */
    size_t row = (size_t)frame->width * (size_t)components, stride = (row + 127) / 64 * 64;
    uint8_t *padded = calloc((size_t)frame->height + 1, stride);
    uint8_t *packed = malloc(row * (size_t)frame->height);
    struct SwsContext *scaler = sws_getContext(
        frame->width, frame->height, (enum AVPixelFormat)frame->format, frame->width, frame->height,
        alpha ? AV_PIX_FMT_RGBA : AV_PIX_FMT_RGB24,
        SWS_BILINEAR | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT | SWS_BITEXACT, NULL, NULL, NULL);
    bool fine = padded && packed && scaler;
    if (fine) {
        set_matrix(scaler, frame);
        uint8_t *const rows[4] = {padded};
        const int strides[4] = {(int)stride};
        fine = sws_scale(scaler, (const uint8_t *const *)frame->data, frame->linesize, 0,
                         frame->height, rows, strides) == frame->height;
    }
    size_t height = (size_t)frame->height;
    for (size_t y = 0; fine && y < height; y++)
        memcpy(packed + y * row, padded + (height - 1 - y) * stride, row);
    sws_freeContext(scaler);
    free(padded);
    if (!fine) {
        free(packed);
        return "its first frame cannot be converted to RGB";
    }
    *image = (plr_image){.width = (uint32_t)frame->width,
                         .height = (uint32_t)frame->height,
                         .depth = 1,
                         .components = (uint32_t)components,
                         .type = PLR_UNORM8,
                         .samples = packed};
    return NULL;
}

static void close_movie(movie *m) {
    av_frame_free(&m->frame);
    av_packet_free(&m->packet);
    avcodec_free_context(&m->codec);
    avformat_close_input(&m->format);
    if (m->io) {
        av_freep(&m->io->buffer);
        avio_context_free(&m->io);
    }
}

/* The libraries print what they think of a file; the level of that is theirs alone to keep. */
const char *plr_movie_decode(const char *data, size_t length, plr_image *image) {
    input in = {data, length, 0};
    movie m = {0};
    int level = av_log_get_level();
    av_log_set_level(AV_LOG_QUIET);
    const char *fault = NULL;
    if (!open_format(&m, &in))
        fault = "it is a movie of a format that is not read, or damaged";
    else if (!open_codec(&m))
        fault = "the movie has no video that can be decoded";
    else if (!decode_frame(&m))
        fault = "the first frame of the movie is damaged";
    else
        fault = convert_frame(m.frame, image);
    close_movie(&m);
    av_log_set_level(level);
    return fault;
}

#endif
